#include "harness/estimators/calibration.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <variant>

#include "harness/estimators/full_slam.hpp"
#include "harness/files/bad_input.hpp"
#include "seif/models.hpp"

namespace harness {

namespace {

constexpr double outlier_probability = 0.01;
/// [1/(m rad)] density of an outlier: a range of up to 10 m and any bearing.
constexpr double outlier_density = 1.0 / (10.0 * 2.0 * std::numbers::pi);

constexpr double smallest_sensor_sd = 1e-4;  // [m, rad] lower limit: every sensor has some error

using Parameters = Eigen::VectorXd;  // logarithms of the standard deviations that are not zero

/// The log-likelihood of each scan of a log.
struct Likelihood {
  std::vector<double> scans;
  std::int64_t outliers = 0;

  double sum() const {
    double total = 0.0;
    for (const double scan : scans) total += scan;
    return total;
  }
};

/// Processes one observation. Returns its log-likelihood.
double take(const CalibrationLog& log, const CalibrationLog::Event& event, const SensorNoise& noise,
            seif::Odometry& belief, std::int64_t& outliers) {
  const seif::PredictedObservation predicted =
      seif::predict_observation(belief.T_previous_current, log.T_robot_sensor, event.p_world_landmark);
  const Eigen::Vector2d v = innovation(event.observation, predicted.z);
  const seif::Matrix23& J = predicted.J_wrt_pose;
  const Eigen::Matrix2d S =
      J * belief.covariance * J.transpose() + covariance(noise, event.observation.range);
  const Eigen::Matrix2d S_inverse = S.inverse();
  const double right = (1.0 - outlier_probability) * std::exp(-0.5 * v.dot(S_inverse * v)) /
                       (2.0 * std::numbers::pi * std::sqrt(S.determinant()));
  const double wrong = outlier_probability * outlier_density;
  if (right < wrong) {
    ++outliers;
  } else {
    const Eigen::Matrix<double, 3, 2> K = belief.covariance * J.transpose() * S_inverse;
    seif::Pose2& pose = belief.T_previous_current;
    const Eigen::Vector3d step = K * v;
    pose = {pose.x + step.x(), pose.y + step.y(), seif::wrap_angle(pose.theta + step.z())};
    const Eigen::Matrix3d P = belief.covariance - K * S * K.transpose();
    belief.covariance = 0.5 * (P + P.transpose());
  }
  return std::log(right + wrong);
}

void add_likelihood(const CalibrationLog& log, const LogNoise& noise, Likelihood& likelihood) {
  seif::Odometry belief{0.0, log.start.mean, log.start.covariance};  // as a motion from the world's origin
  for (const CalibrationLog::Event& event : log.events) {
    if (event.is_motion) {
      const seif::Odometry motion{0.0, event.T_previous_current,
                                  covariance(*noise.odometry, event.T_previous_current)};
      belief = compose(belief, motion);
      continue;
    }
    if (event.begins_scan) likelihood.scans.push_back(0.0);
    likelihood.scans.back() += take(log, event, *noise.sensor, belief, likelihood.outliers);
  }
}

/// The search for the parameters: which are not zero, and their values.
class Search {
 public:
  Search(const std::vector<CalibrationLog>& logs, const NoiseValues& guess) : logs_(logs), values_(guess) {
    for (int i = 0; i < noise_parameters; ++i) {
      if (guess[static_cast<std::size_t>(i)] > 0.0) free_.push_back(static_cast<std::size_t>(i));
    }
  }

  /// Sets parameters that cannot be distinguished from zero to zero, one after the other.
  void run() {
    climb();
    for (std::optional<std::size_t> vague = vaguest(); vague; vague = vaguest()) {
      values_[free_[*vague]] = 0.0;
      free_.erase(free_.begin() + static_cast<std::ptrdiff_t>(*vague));
      climb();
    }
  }

  Calibration result() const {
    Calibration calibration;
    calibration.values = values_;
    for (std::size_t i = 0; i < free_.size(); ++i)
      calibration.standard_errors[free_[i]] = values_[free_[i]] * error_of_log(i);
    for (const CalibrationLog& log : logs_) calibration.observations += log.observations;
    calibration.outliers = at(parameters()).outliers;
    return calibration;
  }

 private:
  Parameters parameters() const {
    Parameters x(static_cast<Eigen::Index>(free_.size()));
    for (std::size_t i = 0; i < free_.size(); ++i)
      x(static_cast<Eigen::Index>(i)) = std::log(values_[free_[i]]);
    return x;
  }

  NoiseValues values_at(const Parameters& x) const {
    NoiseValues values = values_;
    for (std::size_t i = 0; i < free_.size(); ++i)
      values[free_[i]] = std::max(smallest_sensor_sd, std::exp(x(static_cast<Eigen::Index>(i))));
    return values;
  }

  Likelihood at(const Parameters& x) const {
    Likelihood likelihood;
    const LogNoise noise = noise_of(values_at(x));
    for (const CalibrationLog& log : logs_) add_likelihood(log, noise, likelihood);
    return likelihood;
  }

  /// The derivatives of the log-likelihoods with respect to the parameters, one row for each scan.
  Eigen::MatrixXd scores_at(const Parameters& x) const {
    constexpr double step = 1e-3;
    Eigen::MatrixXd scores;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      Parameters more = x;
      Parameters less = x;
      more(i) += step;
      less(i) -= step;
      const Likelihood a = at(more);
      const Likelihood b = at(less);
      if (i == 0) scores.resize(static_cast<Eigen::Index>(a.scans.size()), x.size());
      for (std::size_t k = 0; k < a.scans.size(); ++k)
        scores(static_cast<Eigen::Index>(k), i) = (a.scans[k] - b.scans[k]) / (2.0 * step);
    }
    return scores;
  }

  /// Maximises the likelihood. The information matrix is the sum of the outer products of the scores (Berndt,
  /// Hall, Hall, Hausman 1974).
  void climb() {
    constexpr int most_steps = 60;
    constexpr double small = 1e-3;   // [-] step in the logarithm of a standard deviation
    constexpr double longest = 0.7;  // [-] the same; a factor of two
    double damping = 1.0;
    Parameters x = parameters();
    double best = at(x).sum();
    for (int step = 0; step < most_steps; ++step) {
      const Eigen::MatrixXd scores = scores_at(x);
      const Eigen::VectorXd gradient = scores.colwise().sum();
      information_ = scores.transpose() * scores;
      bool climbs = false;
      Parameters d;
      while (!climbs && damping < 1e9) {
        Eigen::MatrixXd damped = information_;
        damped.diagonal().array() += damping;
        d = damped.llt().solve(gradient);
        d *= std::min(1.0, longest / std::max(d.cwiseAbs().maxCoeff(), 1e-300));
        const double there = at(x + d).sum();
        climbs = there > best;
        if (climbs) best = there;
        damping *= climbs ? 0.2 : 10.0;
      }
      if (!climbs) break;
      x += d;
      values_ = values_at(x);
      if (d.cwiseAbs().maxCoeff() < small) break;
    }
    const Eigen::MatrixXd scores = scores_at(x);
    information_ = scores.transpose() * scores;
  }

  double error_of_log(std::size_t i) const {
    // A parameter without influence on the likelihood must not make the errors of the others infinite.
    Eigen::MatrixXd Omega = information_;
    Omega.diagonal().array() += 1e-6;
    const Eigen::MatrixXd covariance =
        Omega.llt().solve(Eigen::MatrixXd::Identity(Omega.rows(), Omega.cols()));
    const auto k = static_cast<Eigen::Index>(i);
    return std::sqrt(covariance(k, k));
  }

  /// The parameter with the largest error, if its logarithm has a standard error above 1, a factor of e.
  std::optional<std::size_t> vaguest() const {
    std::optional<std::size_t> worst;
    double most = 1.0;
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const bool may_be_zero = free_[i] != 4 && free_[i] != 6;  // every sensor has some error
      if (!may_be_zero || error_of_log(i) <= most) continue;
      most = error_of_log(i);
      worst = i;
    }
    return worst;
  }

  const std::vector<CalibrationLog>& logs_;
  NoiseValues values_;
  std::vector<std::size_t> free_;
  Eigen::MatrixXd information_;  // for the parameters
};

}  // namespace

NoiseValues values_of(const LogNoise& noise) {
  const OdometryNoise o = noise.odometry.value_or(OdometryNoise{});
  const SensorNoise s = noise.sensor.value_or(SensorNoise{});
  return {o.distance_sd_per_sqrt_m,
          o.sideways_sd_per_sqrt_m,
          o.turn_sd_per_sqrt_m,
          o.turn_sd_per_sqrt_rad,
          s.range_sd,
          s.range_sd_per_m,
          s.bearing_sd};
}

LogNoise noise_of(const NoiseValues& values) {
  return {.odometry = OdometryNoise{values[0], values[1], values[2], values[3]},
          .sensor = SensorNoise{values[4], values[5], values[6]}};
}

CalibrationLog read_for_calibration(RecordedLog& log) {
  const LogDescription& description = log.description();
  if (!description.landmarks || !description.known_association)
    throw BadInput(
        fmt::format("{}: to calibrate, the log must hold the true landmarks, and observations that "
                    "name them",
                    description.name));
  CalibrationLog result;
  result.start = description.start;
  result.T_robot_sensor = description.T_robot_sensor;
  for (Event event; log.next(event);) {
    CalibrationLog::Event kept;
    if (const auto* odometry = std::get_if<OdometryEvent>(&event)) {
      kept.is_motion = true;
      kept.T_previous_current = odometry->odometry.T_previous_current;
      result.events.push_back(kept);
      continue;
    }
    kept.begins_scan = true;
    for (const seif::Observation& observation : std::get<ScanEvent>(event).scan.observations) {
      const auto truth =
          std::ranges::lower_bound(*description.landmarks, observation.landmark, {}, &TrueLandmark::landmark);
      if (truth == description.landmarks->end() || truth->landmark != observation.landmark) continue;
      kept.observation = observation;
      kept.p_world_landmark = truth->position;
      result.events.push_back(kept);
      kept.begins_scan = false;
      ++result.observations;
    }
  }
  if (result.observations == 0)
    throw BadInput(fmt::format("{}: no known landmark was ever seen", description.name));
  return result;
}

Calibration calibrate(const std::vector<CalibrationLog>& logs, const LogNoise& guess) {
  Search search(logs, values_of(guess));
  search.run();
  const Calibration calibration = search.result();
  if (!std::ranges::all_of(calibration.values, [](double value) { return std::isfinite(value); }))
    throw std::runtime_error("no noise was found under which what was measured is likely");
  return calibration;
}

std::string to_yaml(const Calibration& calibration) {
  std::string text =
      fmt::format("# {} observations, {} of them outliers; behind each value its standard error\n",
                  calibration.observations, calibration.outliers);
  std::istringstream lines(to_yaml(noise_of(calibration.values)));
  std::string line;
  for (std::size_t i = 0; std::getline(lines, line); ++i) {
    const std::string key = line.substr(0, line.find(':'));
    text += calibration.values[i] > 0.0 ? fmt::format("{}: {:.4g}  # +- {:.2g}\n", key, calibration.values[i],
                                                      calibration.standard_errors[i])
                                        : fmt::format("{}: 0  # cannot be told apart from 0\n", key);
  }
  return text;
}

}  // namespace harness
