//! The bits of a scan: stuffed zeros are taken out, and behind a marker come zeros without end.

/// A place among the bytes of a file, with the marker met but not yet taken.
#[derive(Clone, Debug)]
pub(super) struct Rest<'a> {
    bytes: &'a [u8],
    /// A marker that stopped the bits before it.
    pub(super) marker: Option<u8>,
}

/// The file has no more bytes.
#[derive(Debug)]
pub(super) struct Ended;

impl<'a> Rest<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Rest {
            bytes,
            marker: None,
        }
    }

    pub(super) fn byte(&mut self) -> Result<u8, Ended> {
        let (&byte, rest) = self.bytes.split_first().ok_or(Ended)?;
        self.bytes = rest;
        Ok(byte)
    }

    pub(super) fn word(&mut self) -> Result<u16, Ended> {
        Ok(u16::from_be_bytes([self.byte()?, self.byte()?]))
    }

    /// The next bytes, as many as that.
    pub(super) fn take(&mut self, count: usize) -> Result<&'a [u8], Ended> {
        let (taken, rest) = self.bytes.split_at_checked(count).ok_or(Ended)?;
        self.bytes = rest;
        Ok(taken)
    }

    /// The marker that was met, or else the next one, whatever stands before it.
    pub(super) fn next_marker(&mut self) -> Result<u8, Ended> {
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

/// A reader of bits.
#[derive(Debug)]
pub(super) struct Bits<'r, 'a> {
    rest: &'r mut Rest<'a>,
    /// Bits not yet taken, from the highest on, and zeros behind them.
    held: u64,
    count: u32,
    /// True if more bits were taken than there are before the next marker.
    pub(super) is_short: bool,
}

impl<'r, 'a> Bits<'r, 'a> {
    pub(super) fn new(rest: &'r mut Rest<'a>) -> Self {
        Bits {
            rest,
            held: 0,
            count: 0,
            is_short: false,
        }
    }

    /// Fetches bytes up to the next marker.
    fn fill(&mut self) {
        while self.count <= 56 && self.rest.marker.is_none() {
            let Some((&first, mut rest)) = self.rest.bytes.split_first() else {
                return;
            };
            if first == 0xff {
                let code = loop {
                    match rest.split_first() {
                        Some((0xff, behind)) => rest = behind,
                        Some((&code, behind)) => {
                            rest = behind;
                            break code;
                        }
                        None => {
                            self.rest.bytes = rest;
                            return;
                        }
                    }
                };
                if code != 0 {
                    self.rest.bytes = rest;
                    self.rest.marker = Some(code);
                    return;
                }
            }
            self.rest.bytes = rest;
            self.held |= u64::from(first) << (56 - self.count);
            self.count += 8;
        }
    }

    /// The next 17 bits at least, in the highest places.
    #[inline]
    pub(super) fn peek(&mut self) -> u64 {
        if self.count < 32 {
            self.fill();
        }
        self.held
    }

    /// Passes as many of the bits that were peeked at, at most 17.
    #[inline]
    pub(super) fn pass(&mut self, count: u32) {
        self.is_short |= count > self.count;
        self.count = self.count.saturating_sub(count);
        self.held <<= count;
    }

    /// As many bits as a number; at most 16.
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
        self.pass(count);
        bits
    }

    /// A number of as many bits with a sign: those that begin with a zero stand for negative ones.
    #[inline]
    pub(super) fn take_signed(&mut self, count: u32) -> i32 {
        let bits = self.take(count);
        if count > 0 && bits < 1 << (count - 1) {
            bits - (1 << count) + 1
        } else {
            bits
        }
    }

    /// Goes on behind the restart marker of this number. Where another marker stands, it is passed over or left for
    /// later, by its number: it may belong to a part of the scan that is yet to come, and its data then count there.
    pub(super) fn restart(&mut self, number: u8) -> Result<(), Ended> {
        (self.held, self.count) = (0, 0);
        let mut marker = self.rest.next_marker()?;
        loop {
            let ahead = marker.wrapping_sub(0xd0).wrapping_sub(number) & 7;
            match marker {
                0..0xc0 => {}
                0xd0..=0xd7 if ahead == 0 => break,
                0xd0..=0xd7 if ahead == 1 || ahead == 2 => {
                    self.rest.marker = Some(marker);
                    break;
                }
                0xd0..=0xd7 if ahead == 6 || ahead == 7 => {}
                0xd0..=0xd7 => break,
                _ => {
                    self.rest.marker = Some(marker);
                    break;
                }
            }
            marker = self.rest.next_marker()?;
        }
        if self.rest.marker.is_none() {
            self.is_short = false;
        }
        Ok(())
    }
}
