"""A picture of a run."""

from typing import Optional, Sequence

import numpy as np

from .runs import Run


def plot(run: Run, estimators: Optional[Sequence[str]] = None, axes=None):
    """Draws truth, odometry, estimates and maps of a Run, with 2-sigma ellipses. Returns the axes of Matplotlib."""
    import matplotlib.pyplot as plt
    from matplotlib.patches import Ellipse

    axes = plt.subplots(figsize=(7, 7))[1] if axes is None else axes
    truth, odometry = run.truth, run.odometry
    axes.plot(truth.x, truth.y, color="black", linewidth=2, label="truth")
    axes.plot(odometry.x, odometry.y, color="0.7", linewidth=1, label="odometry")
    landmarks = run.landmarks
    axes.scatter(landmarks.x, landmarks.y, marker="+", color="black", linewidths=1, label="landmarks")
    for number, name in enumerate(run.names if estimators is None else estimators):
        color = f"C{number}"
        steps, mapped = run.steps[name], run.map(name)
        axes.plot(steps.x, steps.y, color=color, linewidth=1, label=name)
        axes.scatter(mapped.x, mapped.y, s=8, color=color)
        for one in mapped.dropna(subset=["cov_xx"]).itertuples():
            values, vectors = np.linalg.eigh([[one.cov_xx, one.cov_xy], [one.cov_xy, one.cov_yy]])
            angle = np.degrees(np.arctan2(vectors[1, 1], vectors[0, 1]))
            width, height = 4 * np.sqrt(np.maximum(values[::-1], 0))
            axes.add_patch(Ellipse((one.x, one.y), width, height, angle=angle, fill=False, color=color))
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    axes.legend(loc="upper right", fontsize="small")
    return axes
