"""Decodes frames with canmatrix and a DBC file and compares the raw values of every signal.

usage: canmatrix_oracle.py FILE.dbc FRAMES.json
FRAMES.json: [{"id": 656, "data": "0011..", "signals": {"RawX": -5, ...}}, ...]
Exit codes: 0 all agree (prints their number), 1 they do not, 3 canmatrix is not installed.
"""
import json
import sys

try:
    import canmatrix
    import canmatrix.formats
except ImportError:
    sys.exit(3)


def main(dbc_path, frames_path):
    matrix = canmatrix.formats.loadp_flat(dbc_path)
    with open(frames_path) as source:
        frames = json.load(source)
    for frame in frames:
        message = matrix.frame_by_id(canmatrix.ArbitrationId(frame["id"]))
        if message is None:
            print("id", frame["id"], "is not in the DBC")
            return 1
        decoded = message.decode(bytes.fromhex(frame["data"]))
        expected = {name: int(signal.raw_value) for name, signal in decoded.items()}
        if expected != frame["signals"]:
            print(message.name, frame["data"], "canmatrix:", expected, "codec:", frame["signals"])
            return 1
    undecoded = {m.arbitration_id.id for m in matrix.frames} - {f["id"] for f in frames}
    if undecoded:
        print("messages of the DBC that were never tried:", sorted(undecoded))
        return 1
    print(len(frames), "frames agree")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2]))
