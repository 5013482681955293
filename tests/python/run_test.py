"""Whole runs and comparisons."""

import json
import os
import subprocess

import numpy as np
import pytest

import seifbed
from seifbed import BadInput


def test_a_run_has_the_bits_of_the_command(tmp_path):
    run = seifbed.run("courtyard", estimators=["ekf", "seif"], seed=3, duration=10)
    command = [os.environ["SEIFBED_PROGRAM"], "run", "courtyard", "--seed", "3", "--duration", "10", "--json",
               "--set", "estimators={ekf: {}, seif: {}}", "--out", str(tmp_path / "run")]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    assert run.trajectory_hash == json.loads(printed)["trajectory_hash"]


def test_a_run_is_tables(tiny):
    run = seifbed.run(tiny, seed=2)
    assert run.names == ["ekf", "seif"]
    assert list(run.scores.index) == ["ekf", "seif"]
    assert run.scores.loc["ekf", "nees_pose_final"] > 0
    assert len(run.steps["seif"]) == 20
    assert {"t", "x", "y", "theta", "blocks_touched"} <= set(run.steps["seif"])
    assert len(run.map("ekf")) == run.scores.loc["ekf", "landmarks_mapped"]
    assert len(run.landmarks) == 80
    assert {"t", "x", "y", "theta"} <= set(run.truth)
    assert run.failures == {}


def test_a_run_can_be_kept_and_opened(tiny, tmp_path):
    kept = seifbed.run(tiny, out=tmp_path / "kept")
    assert seifbed.open_run(tmp_path / "kept").trajectory_hash == kept.trajectory_hash
    with pytest.raises(BadInput, match="kept"):
        seifbed.run(tiny, out=tmp_path / "kept")


def test_options_and_settings_reach_the_run(tiny):
    wide = seifbed.run(tiny, estimators={"seif": {"theta_x": 9}}, set={"sensors.landmark_sensor.max_range_m": 3})
    usual = seifbed.run(tiny, estimators="seif")
    assert wide.trajectory_hash != usual.trajectory_hash


def test_a_comparison_has_a_row_for_each_estimator_and_run(tiny):
    many = seifbed.compare(tiny, seeds=range(1, 4))
    assert list(many.scores.index) == ["ekf", "seif"]
    assert len(many.runs) == 6
    assert set(many.runs.estimator) == {"ekf", "seif"}


def test_a_film_is_made(tiny, tmp_path):
    run = seifbed.run(tiny)
    assert seifbed.film(run, tmp_path / "film.mp4", start=1, end=1.2) > 0
    assert (tmp_path / "film.mp4").stat().st_size > 0


def test_a_run_can_be_drawn(tiny):
    axes = seifbed.plot(seifbed.run(tiny))
    assert "seif" in [text.get_text() for text in axes.get_legend().get_texts()]


def test_ones_own_results_have_the_scores_of_the_run(tiny):
    run = seifbed.run(tiny)
    mapped = run.map("ekf")
    covariances = np.stack([mapped[["cov_xx", "cov_xy"]], mapped[["cov_xy", "cov_yy"]]], axis=1)
    scores = seifbed.score(run.truth, run.landmarks, run.steps["ekf"], mapped, {"landmarks": covariances})
    for key in ["ate_rmse_m", "rpe_trans_m", "landmark_rmse_m", "landmark_rmse_aligned_m"]:
        assert scores[key] == pytest.approx(run.scores.loc["ekf", key], rel=1e-9), key
    assert scores["nees_landmark"] == pytest.approx(run.scores.loc["ekf", "nees_landmark_final"], rel=1e-6)


@pytest.mark.parametrize("world, message", [
    ("no_such_world", "no_such_world"),
    ({"name": "a", "robot": {"mass": 3}}, "unknown key 'mass'"),
    ({"name": "a", "duration_s": float("nan")}, "finite"),
    ({"name": "a", "estimators": {"ekf": {"gat": 1}}}, "unknown key 'gat'"),
])
def test_bad_worlds_are_refused(world, message):
    with pytest.raises(BadInput, match=message):
        seifbed.run(seifbed.worlds.from_dict(world) if isinstance(world, dict) else world)


@pytest.mark.parametrize("arguments, error", [
    (dict(world=3), TypeError),
    (dict(world={"name": "a"}), TypeError),
    (dict(estimators=["nonsense"]), BadInput),
    (dict(estimators=[object]), TypeError),
    (dict(estimators=[]), ValueError),
    (dict(seed=-1), BadInput),
    (dict(seed="one"), BadInput),
    (dict(duration=0), BadInput),
    (dict(set={"robot.mas_kg": 3}), BadInput),
])
def test_bad_arguments_are_exceptions(tiny, arguments, error):
    with pytest.raises(error):
        seifbed.run(**{"world": tiny, **arguments})


@pytest.mark.parametrize("arguments", [
    dict(truth=np.zeros((3, 3)), trajectory=np.zeros((3, 4))),
    dict(truth=np.zeros((3, 4)), trajectory=np.zeros(4)),
    dict(truth=np.zeros((3, 4)), trajectory=np.full((3, 4), np.nan)),
    dict(truth=[[1, 0, 0, 0], [0, 0, 0, 0]], trajectory=[[0, 0, 0, 0]]),
    dict(truth=[[0, 0, 0, 0]], trajectory=[[5, 0, 0, 0]]),
    dict(truth=[[0, 0, 0, 0]], trajectory=[[0, 0, 0, 0]], covariances={"poses": np.zeros((2, 3, 3))}),
    dict(truth=[[0, 0, 0, 0]], trajectory=[[0, 0, 0, 0]], covariances={"pose": 1}),
    dict(truth=[[0, 0, 0, 0]], landmarks={1: (0, 0)}, map={2: (0, 0)}),
    dict(truth=[[0, 0, 0, 0]], landmarks={-1: (0, 0)}, map={2: (0, 0)}),
    dict(truth=[[0, 0, 0, 0]]),
])
def test_bad_results_are_exceptions(arguments):
    with pytest.raises(ValueError):
        seifbed.score(**arguments)


def test_plugins_are_loaded():
    seifbed.load_plugin(os.environ["SEIFBED_TEST_PLUGIN"])
    assert "plugged_in" in seifbed.estimators()
    with pytest.raises(BadInput):
        seifbed.load_plugin("/nowhere.so")
