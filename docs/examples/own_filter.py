"""A filter of your own in numpy, live in the simulator beside the EKF: ./seifbed python docs/examples/own_filter.py

It is an EKF without correlations between landmarks: each landmark has a covariance of its own, and the pose has one.
"""

import numpy as np

import seifbed


@seifbed.estimator("lonely", inflation=1.0)
class Lonely:
    """An EKF that believes its landmarks to be independent of each other and of the pose."""

    def __init__(self, start, start_covariance, sensor, inflation):
        self.x, self.P = np.array(start), np.array(start_covariance)
        self.sensor, self.inflation = sensor, inflation
        self.means, self.covariances = {}, {}

    def motion(self, odometry):
        c, s = np.cos(self.x[2]), np.sin(self.x[2])
        R = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])  # turns the robot's frame to that of the world
        step = R @ odometry.motion
        F = np.array([[1, 0, -step[1]], [0, 1, step[0]], [0, 0, 1]])
        self.x = self.x + step
        self.P = F @ self.P @ F.T + self.inflation * R @ odometry.covariance @ R.T

    def measure(self, scan):
        for id, r, b, Q in zip(scan.ids.tolist(), scan.ranges, scan.bearings, scan.covariances):
            c, s = np.cos(self.x[2]), np.sin(self.x[2])
            eye = self.x[:2] + np.array([[c, -s], [s, c]]) @ self.sensor[:2]
            u = self.x[2] + self.sensor[2] + b  # direction of the sighting in the world
            if id not in self.means:
                J = np.array([[np.cos(u), -r * np.sin(u)], [np.sin(u), r * np.cos(u)]])
                G = np.array([[1, 0, -r * np.sin(u)], [0, 1, r * np.cos(u)]])
                self.means[id] = eye + r * np.array([np.cos(u), np.sin(u)])
                self.covariances[id] = J @ Q @ J.T + G @ self.P @ G.T
                continue
            d = self.means[id] - eye
            q, distance = d @ d, np.hypot(*d)
            H = np.array([[-d[0] / distance, -d[1] / distance, 0], [d[1] / q, -d[0] / q, -1]])
            M, C = -H[:, :2], self.covariances[id]
            turn = np.arctan2(d[1], d[0]) - self.x[2] - self.sensor[2]
            v = np.array([r - distance, np.arctan2(np.sin(b - turn), np.cos(b - turn))])
            S = np.linalg.inv(H @ self.P @ H.T + M @ C @ M.T + Q)
            K, L = self.P @ H.T @ S, C @ M.T @ S
            self.x, self.means[id] = self.x + K @ v, self.means[id] + L @ v
            self.P, self.covariances[id] = self.P - K @ H @ self.P, C - L @ M @ C

    def pose(self):
        return self.x

    def map(self):
        return self.means

    def covariance(self, ids):
        joint = np.zeros((3 + 2 * len(ids),) * 2)
        joint[:3, :3] = self.P
        for k, id in enumerate(ids):
            joint[3 + 2 * k:5 + 2 * k, 3 + 2 * k:5 + 2 * k] = self.covariances[id]
        return joint


if __name__ == "__main__":
    run = seifbed.run("courtyard", estimators=["ekf", Lonely], seed=1)
    print(run.scores[["landmark_rmse_aligned_m", "ate_rmse_m", "nees_pose", "nees_landmark"]].round(3))
    seifbed.plot(run).figure.savefig("own_filter.png", dpi=150)
    print("Written to own_filter.png")
