#!/usr/bin/env python3
"""Means over the runs of a team: python3 docs/examples/team_means.py runs/t1 runs/t2 ..."""

import json
import statistics
import sys
from pathlib import Path

FIGURES = {
    "landmarks": ("landmarks_mapped", 0),
    "aligned [m]": ("landmark_rmse_aligned_m", 4),
    "NEES pose": ("nees_pose", 2),
    "NEES map": ("nees_landmark", 2),
    "NEES pose at the end": ("nees_pose_final", 2),
    "NEES map at the end": ("nees_landmark_final", 2),
}


def main(folders):
    robots = []
    for folder in folders:
        robots += json.loads((Path(folder) / "summary.json").read_text())["robots"].values()
    for name in robots[0]["estimators"]:
        scores = [robot["estimators"][name] for robot in robots]
        print(f"{name}, {len(folders)} runs")
        for title, (key, decimals) in FIGURES.items():
            values = [score[key] for score in scores]
            print(f"  {title}: {statistics.mean(values):.{decimals}f}, largest {max(values):.{decimals}f}")
        print(f"  update p50 [us]: {statistics.mean(s['update_us']['p50'] for s in scores):.0f}")
        print(f"  blocks p50: {statistics.mean(s['blocks_touched']['p50'] for s in scores):.0f}")
        exchanged = [robot.get("exchange", {}).get(name) for robot in robots]
        if None in exchanged:
            continue
        print(f"  sent [kB]: {statistics.mean(x['sent_bytes'] for x in exchanged) / 1000:.0f}")
        print(f"  joined: {sum(len(x['joined_s']) for x in exchanged)}")
        print(f"  first join [s]: {statistics.mean(min(x['joined_s'].values()) for x in exchanged):.0f}")


if __name__ == "__main__":
    main(sys.argv[1:])
