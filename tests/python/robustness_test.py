"""Interrupts, threads, the end of the interpreter, and input of the wrong kind."""

import ast
import math
import pathlib
import re
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import seifbed
from seifbed import _seifbed

Q = np.diag([0.01, 0.0004])
R = np.diag([1e-4, 1e-4, 1e-4])
TINY = "seifbed.worlds.from_dict({'name': 'tiny', 'duration_s': 1, 'estimators': {'ekf': {}}})"


def python(code, **kwargs):
    """An interpreter of its own, so that a crash is a result."""
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=300, **kwargs)


def test_ctrl_c_is_pythons_again_after_a_run():
    done = python(f"""
import os, signal, time, seifbed
world = {TINY}
seifbed.run(world); seifbed.compare(world, seeds=[1, 2], jobs=2)
try:
    os.kill(os.getpid(), signal.SIGINT)
    time.sleep(60)
except KeyboardInterrupt:
    print("interrupted")
signal.signal(signal.SIGINT, lambda *_: print("my own"))
seifbed.run(world)
os.kill(os.getpid(), signal.SIGINT)
""")
    assert done.stdout == "interrupted\nmy own\n", done.stderr


def interrupted(code, tmp_path, is_going):
    """What an interpreter prints that gets Ctrl-C as soon as `is_going()`."""
    process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True, cwd=tmp_path)
    end = time.monotonic() + 300
    while process.poll() is None and not is_going() and time.monotonic() < end:
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    return process.communicate(timeout=300)[0]


def test_ctrl_c_reaches_the_main_thread_from_another_ones_run(tmp_path):
    recorded = tmp_path / "run/truth.csv"
    printed = interrupted("""
import threading, time, seifbed
def work():
    try:
        seifbed.run("loop", duration=100000, out="run")
    except KeyboardInterrupt:
        print("the run", flush=True)
thread = threading.Thread(target=work)
thread.start()
try:
    thread.join()
    time.sleep(60)
except KeyboardInterrupt:
    thread.join()
    print("the main thread")
""", tmp_path, lambda: recorded.exists() and recorded.stat().st_size > 0)
    assert printed == "the run\nthe main thread\n"


def test_ctrl_c_ends_a_film(tmp_path):
    seifbed.run("courtyard", estimators=["ekf"], seed=1, out=tmp_path / "run")
    printed = interrupted("""
import seifbed
try:
    seifbed.film("run", "film.mp4", set={"film.fps": 120})
    print("the whole film")
except KeyboardInterrupt:
    print("interrupted")
""", tmp_path, lambda: any(tmp_path.glob("*film*")))
    assert printed == "interrupted\n"


def test_a_process_that_is_forked_during_a_run_can_be_ended():
    done = python("""
import os, signal, threading, seifbed
begun = threading.Event()
@seifbed.estimator("mine")
class Mine:
    def __init__(self, **setup): begun.set()
    def motion(self, odometry): pass
    def measure(self, scan): pass
    def pose(self): return (0, 0, 0)
    def map(self): return {}
def run(): seifbed.run("courtyard", duration=100000, estimators=[Mine])
threading.Thread(target=run, daemon=True).start()
begun.wait()
sleeper = os.fork()
if sleeper == 0:
    signal.pause()
    os._exit(5)
os.kill(sleeper, signal.SIGTERM)
print(os.waitpid(sleeper, 0)[1])
""")
    assert (done.returncode, done.stdout) == (0, f"{signal.SIGTERM.value}\n"), done.stderr


def test_python_may_end_while_daemon_threads_run():
    done = python("""
import threading, time, seifbed
begun = threading.Semaphore(0)
@seifbed.estimator("mine")
class Mine:
    def __init__(self, **setup): begun.release()
    def motion(self, odometry): pass
    def measure(self, scan): pass
    def pose(self): return (0, 0, 0)
    def map(self): return {}
def steps():
    env = seifbed.make("courtyard", seed=1)
    begun.release()
    while True: env.step((0.5, 0.1))
def run(): seifbed.run("courtyard", duration=100000, estimators=[Mine])
for work in (run, steps): threading.Thread(target=work, daemon=True).start()
begun.acquire(); begun.acquire()
print("ending")
""")
    assert (done.returncode, done.stdout, done.stderr) == (0, "ending\n", "")


def test_an_environment_is_looked_at_by_one_thread_at_a_time():
    env = seifbed.make("courtyard", seed=1)
    mistakes, ended = set(), threading.Event()

    def look():
        while not ended.is_set():
            try:
                env.truth(), env.physics_steps, env.reset(seed=2)
            except RuntimeError as mistake:
                mistakes.add(str(mistake))

    thread = threading.Thread(target=look)
    thread.start()
    for _ in range(300):
        try:
            env.step((0.5, 0.1))
        except RuntimeError as mistake:
            mistakes.add(str(mistake))
    ended.set()
    thread.join()
    assert mistakes <= {"another thread is using this environment"}


def scan(**change):
    arguments = dict(t=0.0, ids=[1, 2], ranges=[1, 2], bearings=[0.1, 0.2], covariances=Q)
    return seifbed.Scan(**{**arguments, **change})


@pytest.mark.parametrize("change", [
    dict(), dict(ids=np.array([1, 2], dtype=np.uint8)), dict(ids=(1, 2)), dict(ranges=np.float32([1, 2])),
    dict(ranges=np.arange(1, 9)[::4] * 1.0), dict(covariances=np.asfortranarray(np.stack([Q, Q]))),
    dict(covariances=Q + 1e-12 * np.array([[0, 1], [0, 0]])), dict(covariances=np.float32(Q)),
])
def test_lists_and_arrays_of_any_kind_are_taken(change):
    one = scan(**change)
    assert one.ids.tolist() == [1, 2] and len(one.ranges) == 2
    np.testing.assert_allclose(one.covariances, [Q, Q], rtol=1e-6, atol=1e-9)


def test_an_empty_scan_is_one():
    assert len(seifbed.Scan(0, [], [], [], Q)) == 0
    seifbed.Seif().measure([], [], [], Q)


@pytest.mark.parametrize("change", [
    dict(t=math.nan), dict(t=math.inf), dict(ranges=[1, 1e300]), dict(bearings=[0, -1e300]), dict(ranges=[1j, 2]),
    dict(ranges=np.array([1, None])), dict(ranges=[True, False]), dict(ranges=[[1], [2, 3]]), dict(ranges="12"),
    dict(bearings=np.array(["1", "2"])), dict(ids=np.array(3)), dict(ids=None), dict(ids=[True, False]),
    dict(ids=[[1], [2, 3]]), dict(ids={1: 2}), dict(ids=np.array([1, 2**63], dtype=np.uint64)), dict(ids=["1", "2"]),
    dict(covariances=0.1), dict(covariances=[0.1, 0.1]), dict(covariances=[[1, 0.1], [0, 1]]),
    dict(covariances=np.diag([1e-30, 1])), dict(covariances=np.diag([1e30, 1])), dict(covariances=Q * 1j),
])
def test_scans_of_the_wrong_kind_are_exceptions(change):
    with pytest.raises((TypeError, ValueError)):
        scan(**change)


@pytest.mark.parametrize("arguments", [
    (math.nan, (0, 0, 0), R), (0, (1j, 0, 0), R), (0, (1e300, 0, 0), R), (0, np.array([None, 1, 2]), R),
    (0, (0, 0, 0), R * 1e30), (0, (0, 0, 0), np.array([[1, 9, 0], [9, 1, 0], [0, 0, 1.0]])), (0, 3, R),
    (0, (0, 0, 0), R + np.triu(np.ones((3, 3)), 1)), (None, (0, 0, 0), R), (0, (0, 0, 0), "abc"),
])
def test_motions_of_the_wrong_kind_are_exceptions(arguments):
    with pytest.raises((TypeError, ValueError)):
        seifbed.Odometry(*arguments)


def test_a_motion_may_be_certain_and_rounded():
    G = np.array([[0.3, 0.1], [0.2, -0.7], [1.3, 0.9]])
    singular = G @ np.diag([1e-4, 2e-4]) @ G.T  # rank two, and not symmetric to the last bit
    for covariance in (np.zeros((3, 3)), singular, singular + 1e-20 * np.triu(np.ones((3, 3)))):
        motion = seifbed.Odometry(0, (1, 0, 0), covariance)
        np.testing.assert_array_equal(motion.covariance, motion.covariance.T)


@pytest.mark.parametrize("setup", [
    dict(start_covariance=np.array([[1, 9, 0], [9, 1, 0], [0, 0, 1.0]])), dict(start=(math.nan, 0, 0)),
    dict(start_covariance=np.array([[1, 0.5, 0], [0, 1, 0], [0, 0, 1.0]])), dict(sensor=(0, 0)), dict(sensor="abc"),
    dict(seed=-1), dict(seed=1.5), dict(theta_x=2**70), dict(theta_x=None), dict(start=(0, 0, 1j)),
])
def test_filters_of_the_wrong_kind_are_exceptions(setup):
    with pytest.raises((TypeError, ValueError)):
        seifbed.Seif(**setup)


def test_numbers_of_numpy_are_numbers(tiny):
    run = seifbed.run(tiny, seed=np.int64(3), duration=np.float32(1), set={"robot.mass_kg": np.float64(9)})
    assert run.summary["seed"] == 3
    many = seifbed.compare(tiny, seeds=np.arange(2), duration=1, estimators=["ekf"])
    assert set(many.runs.seed) == {0, 1}
    seifbed.worlds.resolved(seifbed.worlds.from_dict({"name": "a", "duration_s": np.float32(1)}))


@pytest.mark.parametrize("arguments", [
    dict(seeds=[]), dict(seeds=[-1]), dict(seeds=[1.5]), dict(seeds=[2**64]), dict(seeds=[1, 2], jobs=0),
    dict(seeds=[1, 2], jobs=1.5), dict(seeds=[1, 2], baseline="nonsense"), dict(seeds=3),
])
def test_comparisons_of_the_wrong_kind_are_exceptions(tiny, arguments):
    with pytest.raises((TypeError, ValueError)):
        seifbed.compare(tiny, **arguments)


@pytest.mark.parametrize("function, behaviour, message", [
    ("map", lambda self: {-1: (1, 2)}, "-1 is no landmark"),
    ("map", lambda self: {2**40: (1, 2)}, "is no landmark"),
    ("map", lambda self: {1.5: (1, 2)}, "integer"),
    ("map", lambda self: {1: (1, math.nan)}, "finite"),
    ("pose", lambda self: np.array([1j, 0, 0]), "numbers"),
    ("covariance", lambda self, ids: np.triu(np.ones((3 + 2 * len(ids),) * 2)), "symmetric"),
    ("covariance", lambda self, ids: np.full((3 + 2 * len(ids),) * 2, math.nan), "finite"),
])
def test_an_estimators_wrong_values_end_it_and_not_the_others(tiny, odometer, function, behaviour, message):
    name = f"wrong_{abs(hash((function, message)))}"
    mine = seifbed.estimator(name)(type("Wrong", (odometer,), {function: behaviour}))
    run = seifbed.run(tiny, estimators=["ekf", mine])
    assert list(run.failures) == [name] and message in run.failures[name]


def test_a_failure_is_one_line_with_its_place(tiny, odometer):
    class Deep(odometer):
        def motion(self, odometry):
            self.motion(odometry)

    run = seifbed.run(tiny, estimators=[seifbed.estimator("deep")(Deep)])
    assert "RecursionError" in run.failures["deep"] and "robustness_test.py" in run.failures["deep"]
    assert "\n" not in run.failures["deep"] and len(run.failures["deep"]) < 1000


@pytest.mark.parametrize("name, options, message", [
    ("a b", {}, "no name"), ("", {}, "no name"), ("-a", {}, "no name"), ("../a", {}, "no name"),
    ("a" * 65, {}, "no name"),
    ("opts", {"start": 1}, "another name"), ("opts", {"big": 2**70}, "too large"), ("seif", {}, "already"),
])
def test_an_estimators_wrong_name_or_option_is_an_exception(odometer, name, options, message):
    with pytest.raises(ValueError, match=message):
        seifbed.estimator(name, **options)(odometer)


@pytest.mark.parametrize("arguments", [
    dict(rpe_s=0), dict(rpe_s=math.nan), dict(covariances={"poses": np.triu(np.ones((2, 3, 3)))}),
])
def test_scores_of_the_wrong_kind_are_exceptions(arguments):
    poses = np.array([[0, 0, 0, 0], [1, 0, 0, 0.0]])
    with pytest.raises(ValueError):
        seifbed.score(poses, trajectory=poses, **arguments)


def test_a_scan_cannot_be_copied_half():
    import copy
    import pickle

    for half in (copy.copy, copy.deepcopy, pickle.dumps):
        with pytest.raises(TypeError):
            half(scan())


def test_matrices_are_not_copied():
    one = seifbed.Seif()
    stages = one.stages([1, 2], [1, 2], [0, 1], Q)
    assert np.shares_memory(stages[-1].information, stages[-1].information)
    assert one.information().base is not None and one.covariance([1]).base is not None  # memory of C++, handed over
    motion = seifbed.Odometry(0, (1, 0, 0), R)
    assert np.shares_memory(motion.covariance, motion.covariance)
    seen = scan()
    assert np.shares_memory(seen.covariances, seen.covariances)


def test_the_version_is_the_same_everywhere():
    root = pathlib.Path(__file__).parents[2]
    numbers = re.findall(r"version_(?:major|minor|patch)\s*=\s*(\d+)", (root / "seif/version.hpp").read_text())
    assert f'version = "{".".join(numbers)}"' in (root / "pyproject.toml").read_text()


def test_the_package_has_all_its_files():
    source = pathlib.Path(__file__).parents[2] / "python/seifbed"
    built = {path.name for path in pathlib.Path(seifbed.__file__).parent.iterdir()}
    assert {path.name for path in source.iterdir() if path.name != "__pycache__"} <= built


def test_the_stubs_name_what_the_module_has():
    tree = ast.parse((pathlib.Path(seifbed.__file__).parent / "_seifbed.pyi").read_text())
    stubs = {node.name: node for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    assert set(stubs) == {name for name in dir(_seifbed) if not name.startswith("_")}
    for name, node in stubs.items():
        if isinstance(node, ast.ClassDef) and not issubclass(getattr(_seifbed, name), Exception):
            members = {one.name for one in node.body if isinstance(one, ast.FunctionDef)}
            assert members - {"__init__", "__len__"} == {
                one for one in vars(getattr(_seifbed, name)) if not one.startswith("_")}, name
