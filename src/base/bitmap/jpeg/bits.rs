//! Reading bytes and entropy-coded bits. Stuffed zero bytes are removed, and past a marker the bits are zeros.

/// A cursor over the bytes of a file, with a marker that has been read but not handled.
#[derive(Clone, Debug)]
pub(super) struct ByteReader<'a> {
    bytes: &'a [u8],
    /// The marker that ended the entropy-coded data.
    pub(super) marker: Option<u8>,
}

/// The input ends unexpectedly.
#[derive(Debug)]
pub(super) struct UnexpectedEnd;

impl<'a> ByteReader<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        ByteReader {
            bytes,
            marker: None,
        }
    }

    pub(super) fn byte(&mut self) -> Result<u8, UnexpectedEnd> {
        let (&byte, rest) = self.bytes.split_first().ok_or(UnexpectedEnd)?;
        self.bytes = rest;
        Ok(byte)
    }

    pub(super) fn word(&mut self) -> Result<u16, UnexpectedEnd> {
        Ok(u16::from_be_bytes([self.byte()?, self.byte()?]))
    }

    /// The next `count` bytes.
    pub(super) fn take(&mut self, count: usize) -> Result<&'a [u8], UnexpectedEnd> {
        let (bytes, rest) = self.bytes.split_at_checked(count).ok_or(UnexpectedEnd)?;
        self.bytes = rest;
        Ok(bytes)
    }

    /// Returns the pending marker, or else skips to the next one.
    pub(super) fn next_marker(&mut self) -> Result<u8, UnexpectedEnd> {
        if let Some(marker) = self.marker.take() {
            return Ok(marker);
        }
        loop {
            while self.byte()? != 0xff {}
            let mut code = self.byte()?;
            while code == 0xff {
                code = self.byte()?;
            }
            if code != 0 {
                return Ok(code);
            }
        }
    }
}

/// A reader of entropy-coded bits, most significant bit first.
#[derive(Debug)]
pub(super) struct BitReader<'r, 'a> {
    input: &'r mut ByteReader<'a>,
    /// Unread bits, aligned to the most significant bit and followed by zeros.
    buffer: u64,
    buffered_bits: u32,
    /// True if bits were consumed past the next marker.
    pub(super) is_past_end: bool,
}

impl<'r, 'a> BitReader<'r, 'a> {
    pub(super) fn new(input: &'r mut ByteReader<'a>) -> Self {
        BitReader {
            input,
            buffer: 0,
            buffered_bits: 0,
            is_past_end: false,
        }
    }

    /// Refills the buffer, up to the next marker.
    fn fill(&mut self) {
        while self.buffered_bits <= 56 && self.input.marker.is_none() {
            let Some((&first, mut rest)) = self.input.bytes.split_first() else {
                return;
            };
            if first == 0xff {
                let code = loop {
                    match rest.split_first() {
                        Some((0xff, remaining)) => rest = remaining,
                        Some((&code, remaining)) => {
                            rest = remaining;
                            break code;
                        }
                        None => {
                            self.input.bytes = rest;
                            return;
                        }
                    }
                };
                if code != 0 {
                    self.input.bytes = rest;
                    self.input.marker = Some(code);
                    return;
                }
            }
            self.input.bytes = rest;
            self.buffer |= u64::from(first) << (56 - self.buffered_bits);
            self.buffered_bits += 8;
        }
    }

    /// At least the next 17 bits, aligned to the most significant bit.
    #[inline]
    pub(super) fn peek(&mut self) -> u64 {
        if self.buffered_bits < 32 {
            self.fill();
        }
        self.buffer
    }

    /// Consumes `count` peeked bits, at most 17.
    #[inline]
    pub(super) fn consume(&mut self, count: u32) {
        self.is_past_end |= count > self.buffered_bits;
        self.buffered_bits = self.buffered_bits.saturating_sub(count);
        self.buffer <<= count;
    }

    /// Reads `count` bits as an unsigned number; at most 16.
    #[inline]
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_possible_wrap,
        reason = "at most 16 bits are left"
    )]
    pub(super) fn take(&mut self, count: u32) -> i32 {
        if count == 0 {
            return 0;
        }
        let bits = (self.peek() >> (64 - count)) as i32;
        self.consume(count);
        bits
    }

    /// Reads a signed number of `count` bits (`EXTEND` in T.81, F.2.2.1): a leading zero means negative.
    #[inline]
    pub(super) fn take_signed(&mut self, count: u32) -> i32 {
        let bits = self.take(count);
        if count > 0 && bits < 1 << (count - 1) {
            bits - (1 << count) + 1
        } else {
            bits
        }
    }

    /// Synchronises to restart marker `number`, like libjpeg. A marker slightly ahead is left pending, because data
    /// were lost and its interval is still to come; a marker slightly behind is skipped.
    pub(super) fn restart(&mut self, number: u8) -> Result<(), UnexpectedEnd> {
        (self.buffer, self.buffered_bits) = (0, 0);
        let mut marker = self.input.next_marker()?;
        loop {
            let ahead = marker.wrapping_sub(0xd0).wrapping_sub(number) & 7;
            match marker {
                0..0xc0 => {}
                0xd0..=0xd7 if ahead == 0 => break,
                0xd0..=0xd7 if ahead == 1 || ahead == 2 => {
                    self.input.marker = Some(marker);
                    break;
                }
                0xd0..=0xd7 if ahead == 6 || ahead == 7 => {}
                0xd0..=0xd7 => break,
                _ => {
                    self.input.marker = Some(marker);
                    break;
                }
            }
            marker = self.input.next_marker()?;
        }
        if self.input.marker.is_none() {
            self.is_past_end = false;
        }
        Ok(())
    }
}
