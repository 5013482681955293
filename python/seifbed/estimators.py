"""The types of estimators, and how to add one."""

import inspect
import re
from typing import Callable, Union

from . import _seifbed
from .worlds import Path


def estimators() -> dict[str, dict]:
    """A dictionary of all types of estimators: name -> {"help": ..., "options": {key: default}}."""
    return {one["name"]: {"help": one["help"], "options": one["options"]} for one in _seifbed.estimators()}


def load_plugin(library: Path) -> None:
    """Adds the estimators of a shared library (docs/plugins.md). Raises BadInput if it is no plug-in."""
    _seifbed.load_plugin(library)


def estimator(name: str, **options: Union[bool, int, float, str]) -> Callable[[type], type]:
    """Makes a class of Python an estimator that worlds, runs and comparisons know by `name`.

    The class is made with keywords: start (3,), start_covariance (3, 3), sensor (3,), which is T_robot_sensor, and each
    of `options`, whose values here are the defaults. It has these functions:

        motion(odometry)   odometry.motion (3,), odometry.covariance (3, 3)
        measure(scan)      scan.ids (n,), scan.ranges (n,), scan.bearings (n,), scan.covariances (n, 2, 2)
        pose()             returns (3,)
        map()              returns {landmark: (x, y)}
        covariance(ids)    may be missing; returns the covariance of pose and landmarks, or None

    An exception in one of them ends the estimator in this run; the run's summary tells it.
    """
    if not isinstance(name, str):
        raise TypeError('give a name: @seifbed.estimator("mine")')
    if not re.fullmatch(r"[A-Za-z0-9_][A-Za-z0-9_-]{0,63}", name):
        raise ValueError(f"{name!r} is no name: use at most 64 letters, digits, '_' and '-', not beginning with '-'")
    taken = sorted({"start", "start_covariance", "sensor"} & set(options))
    if taken:
        raise ValueError(f"the option {taken[0]!r} needs another name: every estimator is told its {taken[0]}")

    def register(cls):
        missing = [one for one in ("motion", "measure", "pose", "map") if not callable(getattr(cls, one, None))]
        if missing:
            raise TypeError(f"{cls.__name__} lacks {', '.join(one + '()' for one in missing)}")

        def make(start, start_covariance, sensor, chosen):
            return cls(start=start, start_covariance=start_covariance, sensor=sensor, **chosen)

        summary = (inspect.getdoc(cls) or "An estimator in Python.").splitlines()[0]
        if name in estimators():
            raise ValueError(f"there is an estimator {name!r} already")
        _seifbed.add_estimator(name, summary, options, make)
        cls.seifbed_name = name
        return cls

    return register
