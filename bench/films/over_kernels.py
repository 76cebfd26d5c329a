"""How long a film's frames took beside their kernels, from files of splotchcl movie --timeline.

usage: over_kernels.py TIMELINE...
A line of Markdown for each: from frame to frame, the frame's kernels, the ratio, and the host's
parts; medians over all frames but the first two, in milliseconds. The device draws one frame at a
time, so from frame to frame is from the end of one's last kernel to that of the next one's.
"""

import collections
import json
import statistics
import sys

PARTS = ("load", "plan", "check", "finish", "write")


def covered(spans):
    """Length of what spans cover together."""
    total, end = 0.0, float("-inf")
    for first, last in sorted(spans):
        total += max(0.0, last - max(first, end))
        end = max(end, last)
    return total


def row_of(path):
    with open(path, encoding="utf-8") as file:
        events = json.load(file)["traceEvents"]
    rows = {e["tid"]: e["args"]["name"] for e in events if e["ph"] == "M"}
    kernels, parts = collections.defaultdict(list), collections.defaultdict(lambda: [0.0] * len(PARTS))
    for event in events:
        if event["ph"] != "X":
            continue
        frame = event["args"]["frame"]
        if rows[event["tid"]] == "device":
            kernels[frame].append((event["ts"], event["ts"] + event["dur"]))
        elif event["name"] in PARTS:
            parts[frame][PARTS.index(event["name"])] += event["dur"]
    frames = sorted(kernels)
    ends = [max(end for _, end in kernels[frame]) for frame in frames]
    steps = [b - a for a, b in zip(ends[1:], ends[2:])]
    device = [covered(kernels[frame]) for frame in frames[2:]]
    ratios = [step / kernel for step, kernel in zip(steps, device)]
    host = [statistics.median(parts[f][p] for f in frames[2:]) for p in range(len(PARTS))]
    times = [statistics.median(steps), statistics.median(device)]
    numbers = [f"{time / 1000:.1f}" for time in times] + [f"{statistics.median(ratios):.2f}"]
    return f"| {path} | " + " | ".join(numbers + [f"{time / 1000:.1f}" for time in host]) + " |"


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    print("| | from frame to frame | kernels | ratio | " + " | ".join(PARTS) + " |")
    print("|---|" + "--:|" * (3 + len(PARTS)))
    for path in sys.argv[1:]:
        print(row_of(path))


main()
