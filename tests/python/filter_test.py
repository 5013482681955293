"""Filters alone, and environments."""

import math
import os
import resource
import threading

import numpy as np
import pytest

import seifbed

Q = np.diag([0.01, 0.0004])
R = np.diag([1e-4, 1e-4, 1e-4])


def driven(name="seif", **options):
    one = seifbed.Filter(name, start=(1, 2, 0.3), start_covariance=np.diag([0.01, 0.02, 0.03]), **options)
    one.motion((0.5, 0, 0.2), R)
    one.measure([7, 3], [2.0, 3.0], [0.5, -0.5], Q)
    return one


def test_a_filter_maps_what_it_sees():
    one = driven()
    assert list(one.map()) == [7, 3]
    assert one.pose().shape == (3,)
    assert one.covariance([3, 7]).shape == (7, 7)
    pose, landmarks = one.covariances([3, 7])
    assert pose.shape == (3, 3) and landmarks.shape == (2, 2, 2)
    np.testing.assert_allclose(one.covariance([3, 7])[3:5, 3:5], landmarks[0], rtol=1e-9)
    assert one.information().shape == (7, 7)
    assert one.counts()["blocks_touched"] > 0


def test_the_ekf_and_the_eif_agree():
    ekf, eif = driven("ekf"), driven("eif")
    np.testing.assert_allclose(ekf.pose(), eif.pose(), atol=1e-9)
    np.testing.assert_allclose(ekf.covariance([7]), eif.covariance([7]), rtol=1e-6)


def test_stages_show_the_matrix_before_and_after():
    one = driven("seif_report", theta_x=2)
    one.motion((0.5, 0, 0.2), R)
    stages = one.stages([7, 3, 9], [1.6, 2.7, 4.0], [0.4, -0.8, 0.1], Q)
    assert [stage.name for stage in stages][:2] == ["motion", "measurement"]
    assert "sparsification" in [stage.name for stage in stages]
    assert stages[0].information.shape == (7, 7)
    assert stages[-1].information.shape == (9, 9)
    assert 9 in [link for stage in stages for link in stage.links]
    np.testing.assert_array_equal(stages[-1].information, one.information())


def test_a_scan_is_views_of_one_memory():
    scan = seifbed.Scan(0.5, np.array([4, 2]), [1.0, 2.0], [0.1, 0.2], np.stack([Q, 2 * Q]))
    assert len(scan) == 2 and scan.t == 0.5
    assert scan.ids.tolist() == [4, 2]
    np.testing.assert_array_equal(scan.covariances[1], 2 * Q)
    for view in (scan.ids, scan.ranges, scan.bearings, scan.covariances):
        assert view.base is not None and not view.flags.writeable
    ranges = scan.ranges
    del scan
    assert ranges.tolist() == [1.0, 2.0], "the view keeps the scan alive"


@pytest.mark.parametrize("change, error", [
    (dict(ids=[1.5, 2]), TypeError),
    (dict(ids=["a", "b"]), TypeError),
    (dict(ids=[-1, 2]), ValueError),
    (dict(ids=[2, 2]), ValueError),
    (dict(ids=[1, 2**40]), ValueError),
    (dict(ids=[[1, 2]]), ValueError),
    (dict(ids=[1, 2, 3]), ValueError),
    (dict(ranges=[1.0]), ValueError),
    (dict(ranges=[1.0, math.nan]), ValueError),
    (dict(ranges=[1.0, -1.0]), ValueError),
    (dict(ranges=[[1.0, 2.0]]), ValueError),
    (dict(ranges=["near", "far"]), ValueError),
    (dict(bearings=[0.1, math.inf]), ValueError),
    (dict(covariances=np.eye(3)), ValueError),
    (dict(covariances=-np.eye(2)), ValueError),
    (dict(covariances=np.array([[1, 2], [2, 1]])), ValueError),
    (dict(covariances=np.zeros((2, 2, 3))), ValueError),
    (dict(covariances=None), TypeError),
])
def test_bad_scans_are_exceptions(change, error):
    scan = dict(ids=[1, 2], ranges=[1.0, 2.0], bearings=[0.1, 0.2], covariances=Q)
    with pytest.raises(error):
        driven().measure(**{**scan, **change})


@pytest.mark.parametrize("motion, covariance, error", [
    ((1, 2), R, ValueError),
    ((1, 2, math.nan), R, ValueError),
    ((1, 2, 3), np.eye(2), ValueError),
    ((1, 2, 3), -np.eye(3), ValueError),
    ((1, 2, 3), np.array([[1, 2, 0], [0, 1, 0], [0, 0, 1]]), ValueError),
    ((1, 2, 3), None, TypeError),
    ("abc", R, ValueError),
])
def test_bad_motions_are_exceptions(motion, covariance, error):
    with pytest.raises(error):
        driven().motion(motion, covariance)


@pytest.mark.parametrize("make, error", [
    (lambda: seifbed.Filter("nonsense"), ValueError),
    (lambda: seifbed.Seif(theta_y=3), ValueError),
    (lambda: seifbed.Seif(theta_x="six"), ValueError),
    (lambda: seifbed.Seif(theta_x=[6]), TypeError),
    (lambda: seifbed.Seif(start=(0, 0)), ValueError),
    (lambda: seifbed.Seif(start_covariance=np.zeros((3, 3))), ValueError),
    (lambda: driven().covariance([99]), ValueError),
])
def test_bad_filters_are_exceptions(make, error):
    with pytest.raises(error):
        make()


def test_an_environment_repeats_itself():
    env = seifbed.make("courtyard", seed=5)

    def drive():
        env.reset(seed=5)
        seen = []
        for k in range(40):
            observation, truth = env.step((0.5, 0.1 * math.sin(k)))
            seen.append([observation.t, *observation.odometry.motion, *truth["pose"]])
            if observation.scan is not None:
                seen.append(observation.scan.ranges.tolist())
        return seen

    first = drive()
    assert drive() == first
    assert env.physics_steps == 40 * 12


def test_a_filter_follows_an_environment():
    env = seifbed.make("courtyard", seed=1)
    env.reset()
    seif = seifbed.Seif(start=env.start, start_covariance=env.start_covariance, sensor=env.sensor)
    for _ in range(200):
        observation, truth = env.step((0.5, 0.1))
        seif.motion(observation.odometry)
        if observation.scan is not None:
            seif.measure(observation.scan)
    error = np.hypot(*(seif.pose()[:2] - truth["pose"][:2]))
    assert error < 0.5
    assert len(seif.map()) > 3


def test_an_environment_ends_with_its_duration():
    env = seifbed.make("courtyard", seed=1, duration=0.1)
    env.reset()
    for _ in range(2):
        env.step((0, 0))
    with pytest.raises(StopIteration):
        env.step((0, 0))


@pytest.mark.parametrize("action, error", [
    ((math.nan, 0), ValueError), ((0, math.inf), ValueError), ((1,), ValueError), (("fast", 0), TypeError), (3, TypeError)])
def test_bad_actions_are_exceptions(action, error):
    env = seifbed.make("courtyard", seed=1)
    env.reset()
    with pytest.raises(error):
        env.step(action)


def test_an_environment_in_several_threads_is_no_crash():
    env = seifbed.make("courtyard", seed=1)
    mistakes = []

    def drive():
        for _ in range(200):
            try:
                env.step((0.5, 0.1))
            except RuntimeError as error:
                mistakes.append(str(error))

    threads = [threading.Thread(target=drive) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all("another thread" in mistake for mistake in mistakes)


@pytest.mark.skipif("asan" in os.environ.get("LD_PRELOAD", ""), reason="the sanitizer keeps what is freed")
def test_resets_do_not_leak(tiny):
    env = seifbed.make(tiny, seed=1)
    for _ in range(200):
        env.reset()
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for k in range(2000):
        env.reset(seed=k)
        env.step((0.5, 0))
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    assert grown < 2000, f"{grown} kB"
