"""Pictures in the portable pixmap format, the one that all renderers write."""

import re


def read(path):
    """Width, height and the bytes, three a pixel."""
    data = path.read_bytes()
    head = re.match(rb"P6\s+(\d+)\s+(\d+)\s+255\s", data)
    if not head:
        raise RuntimeError(f"{path} is no pixmap of bytes")
    width, height = map(int, head.groups())
    return width, height, data[head.end():]


def srgb(value):
    """A linear value from 0 to 1 as a byte of sRGB."""
    value = 12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055
    return round(255 * value)


def linear(byte):
    """A byte of sRGB as a linear value from 0 to 255."""
    value = byte / 255
    return 255 * (value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4)


def covered(path, background):
    """The number of pixels of an sRGB picture that differ from the linear background."""
    _, _, data = read(path)
    empty = bytes(map(srgb, background))
    return sum(data[i:i + 3] != empty for i in range(0, len(data), 3))


def unlike(coded, plain, step):
    """The share of pixels where an sRGB picture and a linear one are more than `step` linear steps of 1/255 apart."""
    width, height, ours = read(coded)
    other_width, other_height, theirs = read(plain)
    if (width, height) != (other_width, other_height):
        return 1.0
    lines = [linear(byte) for byte in range(256)]
    off = {i // 3 for i, (a, b) in enumerate(zip(ours, theirs)) if abs(lines[a] - b) > step}
    return len(off) / (width * height)
