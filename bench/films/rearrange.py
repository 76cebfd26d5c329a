"""Other orders and other moments of a snapshot, for the benchmarks of films.

    rearrange.py curve FILE OUTPUT     the particles of each type along a space-filling curve, as
                                       simulations often write them
    rearrange.py earlier FILE OUTPUT   half a kpc/h for each km/s earlier, the order shuffled within
                                       runs of 65536 and for a tenth of the particles all over the
                                       file: the output before FILE

FILE is in Gadget format 2, little-endian, as `splotchcl generate` writes it. Fixed seeds.
"""

import struct
import sys

import numpy as np

TYPES = 6
GAS, STARS = 0, 4
# What only one type has; other blocks have all particles, one type after the other.
TYPES_OF_BLOCKS = {"U": [GAS], "RHO": [GAS], "HSML": [GAS], "HSMS": [STARS], "AGE": [STARS]}
# At a = 1 a particle of 1 km/s moves 10 kpc/h while the scale factor grows by 1.
KPC_PER_KM_S, SCALE_FACTORS = 0.5, 0.05
RUN = 65536
CURVE_BITS = 20


def read_blocks(path):
    with open(path, "rb") as file:
        while head := file.read(16):
            label, following = struct.unpack("<4x4si4x", head)
            yield label.decode().strip(), file.read(following)[4:-4]


def write_blocks(path, blocks):
    with open(path, "wb") as file:
        for label, data in blocks:
            file.write(struct.pack("<i4sii", 8, label.ljust(4).encode(), len(data) + 8, 8))
            size = struct.pack("<i", len(data))
            file.write(size + data + size)


def spread_bits(values):
    """Two zeros between any two bits of numbers of 20 bits."""
    result = np.zeros_like(values)
    for bit in range(CURVE_BITS):
        result |= (values >> np.uint64(bit) & np.uint64(1)) << np.uint64(3 * bit)
    return result


def along_curve(position, box):
    cells = (np.clip(position / box, 0, 0.9999999) * 2**CURVE_BITS).astype(np.uint64)
    keys = sum(spread_bits(cells[:, axis]) << np.uint64(axis) for axis in range(3))
    return np.argsort(keys, kind="stable")


def shuffled(position, _):
    random = np.random.default_rng(1)
    order = np.arange(len(position))
    for first in range(0, len(order), RUN):
        random.shuffle(order[first : first + RUN])
    far = random.choice(len(order), len(order) // 10, replace=False)
    order[far] = order[random.permutation(far)]
    return order


def types_of(label, data, counts):
    """The types that a block has particles of, and the numbers for each particle."""
    types = TYPES_OF_BLOCKS.get(label, [t for t in range(TYPES) if counts[t] > 0])
    return types, len(data) // 4 // sum(counts[t] for t in types)


def rearrange(blocks, order_of):
    header = blocks["HEAD"]
    counts, box = struct.unpack("<6i", header[:24]), struct.unpack("<d", header[128:136])[0]
    positions = np.frombuffer(blocks["POS"], np.float32).reshape(-1, 3)
    ends = np.cumsum(counts)
    orders = {t: order_of(positions[ends[t] - counts[t] : ends[t]], box) for t in range(TYPES) if counts[t] > 0}
    for label, data in blocks.items():
        if label == "HEAD":
            continue
        types, width = types_of(label, data, counts)
        parts = np.split(np.frombuffer(data, np.uint32).reshape(-1, width), np.cumsum([counts[t] for t in types])[:-1])
        blocks[label] = b"".join(part[orders[t]].tobytes() for t, part in zip(types, parts))


def move_back(blocks):
    header = bytearray(blocks["HEAD"])
    box = struct.unpack("<d", header[128:136])[0]
    positions, velocities = (np.frombuffer(blocks[label], np.float32) for label in ("POS", "VEL"))
    blocks["POS"] = np.mod(positions - KPC_PER_KM_S * velocities, box).astype(np.float32).tobytes()
    scale_factor = struct.unpack("<d", header[72:80])[0] - SCALE_FACTORS
    header[72:88] = struct.pack("<2d", scale_factor, 1 / scale_factor - 1)
    blocks["HEAD"] = bytes(header)


def main():
    if len(sys.argv) != 4 or sys.argv[1] not in ("curve", "earlier"):
        sys.exit(__doc__)
    blocks = dict(read_blocks(sys.argv[2]))
    if sys.argv[1] == "earlier":
        rearrange(blocks, shuffled)
        move_back(blocks)
    else:
        rearrange(blocks, along_curve)
    write_blocks(sys.argv[3], blocks.items())


main()
