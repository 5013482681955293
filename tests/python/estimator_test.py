"""Estimators that are classes of Python."""

import itertools
import os
import pathlib
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import seifbed

numbers = itertools.count()


def registered(cls, **options):
    """The class under a new name."""
    return seifbed.estimator(f"test_{next(numbers)}", **options)(type(cls.__name__, (cls,), {}))


def test_it_runs_beside_others_with_its_options(tiny, odometer):
    seen = []

    class Mine(odometer):
        def __init__(self, gain, **setup):
            super().__init__(**setup)
            seen.append(gain)

        def measure(self, scan):
            assert scan.ranges.shape == scan.bearings.shape == scan.ids.shape
            assert scan.covariances.shape == (len(scan), 2, 2)

    mine = registered(Mine, gain=0.5)
    run = seifbed.run(tiny, estimators={"ekf": {}, mine: {"gain": 0.25}})
    assert seen[-1] == 0.25
    assert run.summary["notes"] == [f"{mine.seifbed_name} is a class of Python: its times include Python"]
    assert run.failures == {}
    assert np.isnan(run.scores.loc[mine.seifbed_name, "nees_pose"].astype(float))


def test_its_map_and_covariance_are_scored(tiny, odometer):
    class Knowing(odometer):
        def map(self):
            return {0: (1.0, 2.0), 3: np.array([4.0, 5.0])}

        def covariance(self, ids):
            return np.eye(3 + 2 * len(ids))

    run = seifbed.run(tiny, estimators=[registered(Knowing)])
    assert run.scores.landmarks_mapped[0] == 2
    assert run.scores.nees_landmark_final[0] > 0
    assert "innovation" in run.steps[run.names[0]]


def test_it_can_be_compared(tiny, odometer):
    mine = registered(odometer)
    many = seifbed.compare(tiny, seeds=[1, 2], estimators=["ekf", mine], jobs=2)
    assert len(many.runs) == 4


@pytest.mark.parametrize("function, behaviour, message", [
    ("motion", lambda self, odometry: 1 / 0, "ZeroDivisionError"),
    ("measure", lambda self, scan: [][1], "IndexError"),
    ("pose", lambda self: (1, 2), "shape"),
    ("pose", lambda self: (1, 2, float("nan")), "finite"),
    ("pose", lambda self: "here", "pose"),
    ("pose", lambda self: None, "pose"),
    ("map", lambda self: [1, 2, 3], "map"),
    ("map", lambda self: {"one": (1, 2)}, "map"),
    ("map", lambda self: {1: (1, 2, 3)}, "shape"),
    ("covariance", lambda self, ids: np.eye(2), "shape"),
    ("measure", lambda self, scan: sys.exit(3), "SystemExit"),
])
def test_its_mistakes_end_it_and_not_the_others(tiny, odometer, function, behaviour, message):
    mine = registered(type("Wrong", (odometer,), {function: behaviour}))
    run = seifbed.run(tiny, estimators=["ekf", mine])
    assert list(run.failures) == [mine.seifbed_name]
    assert message in run.failures[mine.seifbed_name]
    assert run.scores.loc["ekf", "landmarks_mapped"] > 0


def test_a_constructor_that_throws_is_an_exception(tiny, odometer):
    class Wrong(odometer):
        def __init__(self, **setup):
            raise KeyError("not today")

    with pytest.raises(ValueError, match="not today"):
        seifbed.run(tiny, estimators=[registered(Wrong)])


@pytest.mark.parametrize("register", [
    lambda cls: seifbed.estimator("ekf")(cls),
    lambda cls: seifbed.estimator("x_with_list", gain=[1])(cls),
    lambda cls: seifbed.estimator(cls),
    lambda cls: seifbed.estimator("x_without_functions")(object),
])
def test_a_class_that_does_not_fit_is_refused(odometer, register):
    with pytest.raises((TypeError, ValueError)):
        register(odometer)


def test_several_threads_may_run(tiny, odometer):
    mine = registered(odometer)
    hashes = []
    threads = [threading.Thread(target=lambda: hashes.append(
        seifbed.run(tiny, estimators=["seif", mine]).trajectory_hash)) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(hashes) == 4 and len(set(hashes)) == 1


def test_a_forked_process_may_run(tiny):
    expected = seifbed.run(tiny).trajectory_hash
    reading, writing = os.pipe()
    if os.fork() == 0:
        try:
            os.write(writing, seifbed.run(tiny).trajectory_hash.encode())
        finally:
            os._exit(0)
    os.wait()
    os.close(writing)
    assert os.read(reading, 100).decode() == expected


def test_ctrl_c_ends_a_run(tmp_path):
    code = ("import seifbed\n"
            "try:\n  seifbed.run('loop', duration=100000, out='run')\n"
            "except KeyboardInterrupt:\n  print('interrupted')\n")
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True, cwd=tmp_path)
    recorded = tmp_path / "run/truth.csv"
    while process.poll() is None and not (recorded.exists() and recorded.stat().st_size > 0):
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    assert process.communicate(timeout=300)[0] == "interrupted\n"


def test_the_example_runs(tmp_path):
    example = pathlib.Path(__file__).parents[2] / "docs/examples/own_filter.py"
    done = subprocess.run([sys.executable, str(example)], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "lonely" in done.stdout
    assert (tmp_path / "own_filter.png").stat().st_size > 10_000
