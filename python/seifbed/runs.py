"""Whole runs, and comparisons of many."""

import atexit
import itertools
import json
import operator
import os
import tempfile
import threading
import weakref
import _thread
from typing import Any, Iterable, Mapping, Optional, Union

import numpy as np
import pandas as pd

from . import _seifbed, worlds
from .worlds import EstimatorsLike, Path, Settings, WorldLike


class Run:
    """A finished run, read from its folder (docs/log_format.md)."""

    def __init__(self, folder, keep=None):
        self.folder = os.fspath(folder)
        self._keep = keep  # the temporary folder lives as long as the run
        with open(os.path.join(self.folder, "summary.json"), encoding="utf-8") as file:
            self.summary = json.load(file)
        self.names = list(self.summary["estimators"])

    def __repr__(self):
        return f"Run({self.summary['world']!r}, seed={self.summary['seed']}, estimators={self.names})"

    @property
    def trajectory_hash(self) -> str:
        """16 hex digits over what the run saw and estimated."""
        return self.summary["trajectory_hash"]

    @property
    def failures(self) -> dict[str, str]:
        """{estimator: why it ended early}; empty if none did."""
        found = {name: one.get("failure") for name, one in self.summary["estimators"].items()}
        return {name: why for name, why in found.items() if why}

    @property
    def scores(self) -> pd.DataFrame:
        """A row for each estimator, with the keys of summary.json (docs/scores.md)."""
        rows = self.summary["estimators"]
        return pd.json_normalize([{"estimator": name, **rows[name]} for name in rows]).set_index("estimator")

    def _table(self, name):
        return pd.read_csv(os.path.join(self.folder, name))

    def _trajectory(self, name):
        path = os.path.join(self.folder, name + ".tum")
        table = pd.read_csv(path, sep=" ", names=["t", "x", "y", "z", "qx", "qy", "qz", "qw"], comment="#")
        angle = 2 * np.arctan2(table.qz, table.qw)
        table["theta"] = np.arctan2(np.sin(angle), np.cos(angle))
        return table[["t", "x", "y", "theta"]]

    @property
    def truth(self) -> pd.DataFrame:
        """The true poses: t, x, y, theta."""
        return self._table("truth.csv")

    @property
    def odometry(self) -> pd.DataFrame:
        """The trajectory of dead reckoning: t, x, y, theta."""
        return self._trajectory("odometry")

    @property
    def observations(self) -> pd.DataFrame:
        """All observations: t, landmark, range, bearing, and their covariances."""
        return self._table("observations.csv")

    @property
    def landmarks(self) -> pd.DataFrame:
        """The true landmarks: landmark, x, y, radius."""
        return self._table("landmarks.csv")

    @property
    def steps(self) -> dict[str, pd.DataFrame]:
        """{estimator: a row for each update}: t, x, y, theta, the covariance of the pose if it is known, counts."""
        return {name: self._trajectory(name).merge(self._table(name + "_steps.csv"), on="t") for name in self.names}

    @property
    def times(self) -> dict[str, pd.DataFrame]:
        """{estimator: the times of each update} [us]."""
        return {name: self._table(name + "_times.csv") for name in self.names}

    @property
    def consistency(self) -> dict[str, pd.DataFrame]:
        """{estimator: NEES at each scoring time}."""
        return {name: self._table(name + "_consistency.csv") for name in self.names}

    def map(self, estimator: str) -> pd.DataFrame:
        """The final map: landmark, x, y, cov_xx, cov_xy, cov_yy."""
        if estimator not in self.names:
            raise KeyError(f"the run has no estimator {estimator!r}, but {self.names}")
        return self._table(estimator + "_map.csv")


_ending = threading.Event()


def _end():
    """Ends what daemon threads still run."""
    _ending.set()
    _seifbed.end_calls()


# The first finalize() registers the function that deletes temporary folders: only what comes later is called before it.
weakref.finalize(_ending, _ending.is_set).detach()
atexit.register(_end)


def _tell_interrupt():
    """Ctrl-C ended a call in C++, which Python has therefore not seen."""
    if _ending.is_set():
        raise SystemExit  # ends a daemon thread, without a word
    if threading.current_thread() is not threading.main_thread():
        _thread.interrupt_main()
    raise KeyboardInterrupt


def open_run(folder: Path) -> Run:
    """A run of `seifbed run`, from its folder."""
    return Run(folder)


def run(world: WorldLike, estimators: EstimatorsLike = None, seed: Optional[int] = None,
        duration: Optional[float] = None, out: Optional[Path] = None, set: Optional[Settings] = None,
        quiet: bool = True) -> Run:
    """Runs a world, as `seifbed run` does, and returns a Run.

    world       a name of the gallery, a file, or seifbed.worlds.from_dict(...)
    estimators  names, classes with @seifbed.estimator, or {name: {option: value}}; by default those of the world
    seed        of everything that is random
    duration    [s]
    out         the folder to write to, empty or new; by default a temporary one, deleted with the Run
    set         {"path.to.key": value}, as --set of the program

    Raises BadInput for a world that is wrong, KeyboardInterrupt after Ctrl-C, RuntimeError if the run broke off. An
    estimator that failed does not raise: see Run.failures.
    """
    keep = None
    if out is None:
        keep = tempfile.TemporaryDirectory(prefix="seifbed_")
        out = os.path.join(keep.name, "run")
    folder = os.fspath(out)
    settings = worlds.overrides(set, seed=seed, duration_s=duration, estimators=worlds.of_estimators(estimators))
    summary, error = _seifbed.run(worlds.path_of(world), settings, folder, quiet)
    if json.loads(summary)["interrupted"]:
        _tell_interrupt()
    if error:
        raise RuntimeError(error)
    return Run(folder, keep)


class Comparison:
    """Estimators over many seeds, as `seifbed compare` has them."""

    def __init__(self, content):
        self.content = content

    @property
    def scores(self) -> pd.DataFrame:
        """A row for each estimator: means over the seeds, with 95 % intervals."""
        rows = self.content["estimators"]
        return pd.json_normalize([{"estimator": name, **rows[name]} for name in rows]).set_index("estimator")

    @property
    def runs(self) -> pd.DataFrame:
        """A row for each run and estimator, with the keys of summary.json."""
        rows = []
        for one in self.content["runs"]:
            for name, scores in one["summary"]["estimators"].items():
                rows.append({"run": one["name"], "seed": one["summary"]["seed"], "estimator": name, **scores})
        return pd.json_normalize(rows)


def compare(world: WorldLike, seeds: Iterable[int] = range(1, 21), estimators: EstimatorsLike = None,
            baseline: str = "", duration: Optional[float] = None, jobs: int = 1, set: Optional[Settings] = None,
            quiet: bool = True) -> Comparison:
    """Runs a world with many seeds, and compares the estimators. Returns a Comparison.

    The other arguments are those of run(). With estimators in Python, `jobs` above 1 brings little.
    """
    chosen = [operator.index(seed) for seed in seeds]
    if not chosen or min(chosen) < 0:
        raise ValueError("seeds: give at least one, and none below zero")
    if operator.index(jobs) < 1:
        raise ValueError("jobs: give at least 1")
    settings = worlds.overrides(set, duration_s=duration, estimators=worlds.of_estimators(estimators))
    text = _seifbed.compare(worlds.path_of(world), settings, chosen, baseline, operator.index(jobs), quiet)
    content = json.loads(text)
    if content["interrupted"]:
        _tell_interrupt()
    return Comparison(content)


def film(run: Union[Run, Path], file: Path, start: Optional[float] = None, end: Optional[float] = None,
         set: Optional[Settings] = None) -> int:
    """Films a run (a Run or its folder) to a file, such as film.mp4. Returns the number of frames.

    start, end  [s] of the run; by default all of it
    set         {"film.camera": "chase"}, the settings of the world's film section
    """
    folder = run.folder if isinstance(run, Run) else os.fspath(run)
    frames, interrupted = _seifbed.film(folder, os.fspath(file), worlds.overrides(set), start, end)
    if interrupted:
        _tell_interrupt()
    return frames


def sweep(world: WorldLike, vary: Mapping[str, Iterable[Any]], seeds: Iterable[int] = range(1, 21),
          estimators: EstimatorsLike = None, baseline: str = "", duration: Optional[float] = None, jobs: int = 1,
          set: Optional[Settings] = None) -> pd.DataFrame:
    """Compares estimators for each combination of settings. Returns a table: a row for each combination and estimator.

    vary  {"path.to.key": [value, ...]}

    The other arguments are those of compare(), and so are the columns of the table (Comparison.scores).
    """
    tables = []
    for values in itertools.product(*vary.values()):
        chosen = dict(zip(vary, values))
        many = compare(world, seeds, estimators, baseline, duration, jobs, {**(set or {}), **chosen})
        tables.append(many.scores.reset_index().assign(**chosen))
    table = pd.concat(tables, ignore_index=True)
    return table[[*vary, *(name for name in table if name not in vary)]]
