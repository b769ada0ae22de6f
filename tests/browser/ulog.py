"""Counts what a record holds, by the ULog specification and docs/formats.md: not with our code."""
import struct
from pathlib import Path


def messages(path):
    """(name, body) of every data message; body without its id."""
    data = Path(path).read_bytes()
    assert data[:7] == b"ULog\x01\x12\x35"
    names, at = {}, 16
    while at + 3 <= len(data):
        size, kind = struct.unpack_from("<HB", data, at)
        body = data[at + 3:at + 3 + size]
        if kind == ord("A"):
            names[struct.unpack_from("<H", body, 1)[0]] = body[3:].decode()
        elif kind == ord("D"):
            yield names[struct.unpack_from("<H", body)[0]], body[2:]
        at += 3 + size


def decision_codes(path):
    """The code of each record of the board's log: u64 time, then 24 bytes, the 11th is the code."""
    return [body[8 + 10] for name, body in messages(path) if name == "decision_log"]


def refusals_with_reading(path):
    """Records with a refusal code and a measured rate (3 x i16 at byte 12): a mark in the plot."""
    records = [body[8:32] for name, body in messages(path) if name == "decision_log"]
    return sum(1 <= r[10] <= 16 and any(struct.unpack_from("<3h", r, 12)) for r in records)


def final_entries(path):
    """Origins (1 factory, 2 learned) in the last table: u64 time, u32 CRC, u16 length, image."""
    last = [body for name, body in messages(path) if name == "corrector_table"][-1]
    image = last[14:]
    return [image[16 + 24 * i + 23] for i in range(struct.unpack_from("<H", image, 2)[0])]
