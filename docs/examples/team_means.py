#!/usr/bin/env python3
"""Means over the runs of a team, of all robots or of one:

python3 docs/examples/team_means.py runs/t1 runs/t2 ... [--robot ada]
"""

import argparse
import json
import statistics
from pathlib import Path

FIGURES = {
    "landmarks": ("landmarks_mapped", 0),
    "aligned [m]": ("landmark_rmse_aligned_m", 4),
    "NEES pose": ("nees_pose", 2),
    "NEES map": ("nees_landmark", 2),
    "NEES pose at the end": ("nees_pose_final", 2),
    "NEES map at the end": ("nees_landmark_final", 2),
}


def mean(values):
    return statistics.mean(list(values))


def print_scores(name, scores):
    print(name)
    for title, (key, decimals) in FIGURES.items():
        values = [score[key] for score in scores]
        print(f"  {title}: {mean(values):.{decimals}f}, largest {max(values):.{decimals}f}")
    for percentile in ("p50", "p99"):
        print(f"  update {percentile} [us]: {mean(score['update_us'][percentile] for score in scores):.0f}")
        print(f"  blocks {percentile}: {mean(score['blocks_touched'][percentile] for score in scores):.0f}")


def print_exchange(exchanged):
    print(f"  sent [kB]: {mean(x['sent_bytes'] for x in exchanged) / 1000:.0f}")
    print(f"  joined: {sum(len(x['joined_s']) for x in exchanged)}")
    first = [min(x["joined_s"].values()) for x in exchanged if x["joined_s"]]
    if first:
        print(f"  first join [s]: {mean(first):.0f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("runs", nargs="+", type=Path)
    parser.add_argument("--robot", help="of this robot alone")
    arguments = parser.parse_args()
    runs = [json.loads((run / "summary.json").read_text()) for run in arguments.runs]
    names = [arguments.robot] if arguments.robot else list(runs[0]["robots"])
    robots = [run["robots"][name] for run in runs for name in names]
    print(f"{len(runs)} runs, {mean(run['realtime_factor'] for run in runs):.0f} times real time")
    for name in robots[0]["estimators"]:
        print_scores(name, [robot["estimators"][name] for robot in robots])
        exchanged = [robot["exchange"][name] for robot in robots if name in robot.get("exchange", {})]
        if exchanged:
            print_exchange(exchanged)


if __name__ == "__main__":
    main()
