#include "harness/peers/mrpt_filter/mrpt_filter.hpp"

#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/slam/CRangeBearingKFSLAM2D.h>

#include <algorithm>
#include <numbers>

namespace peers {

namespace {

mrpt::math::CMatrixDouble33 matrix_of(const std::array<double, 9>& values) {
  mrpt::math::CMatrixDouble33 matrix;
  for (int i = 0; i < 9; ++i) matrix(i / 3, i % 3) = values[static_cast<std::size_t>(i)];
  return matrix;
}

/// Derives from MRPT's class only to set its state, which otherwise begins at the origin with zero
/// covariance.
class Filter final : public MrptFilter, private mrpt::slam::CRangeBearingKFSLAM2D {
 public:
  explicit Filter(const MrptSetup& setup) {
    setVerbosityLevel(mrpt::system::LVL_ERROR);
    KF_options.method = setup.one_scalar_at_once ? mrpt::bayes::kfEKFAlaDavison : mrpt::bayes::kfEKFNaive;
    const auto& [x, y, theta] = setup.sensor_on_robot;
    sensor_ = mrpt::poses::CPose3D(x, y, 0.0, theta, 0.0, 0.0);
    for (int i = 0; i < 3; ++i) m_xkk[i] = setup.start.mean[static_cast<std::size_t>(i)];
    m_pkk = matrix_of(setup.start.covariance);
  }

  void update(const Gaussian& motion, std::span<const Sighting> seen, const SensorNoise& noise) override {
    options.std_sensor_range = static_cast<float>(noise.range_sd);
    options.std_sensor_yaw = static_cast<float>(noise.bearing_sd);
    const auto& [x, y, theta] = motion.mean;
    const mrpt::poses::CPosePDFGaussian moved(mrpt::poses::CPose2D(x, y, theta),
                                              matrix_of(motion.covariance));
    if (m_xkk.size() == 3) move_start(moved);
    mrpt::obs::CActionRobotMovement2D action;
    action.poseChange = mrpt::poses::CPosePDFGaussian::Create(moved);
    mrpt::obs::CActionCollection::Ptr actions = mrpt::obs::CActionCollection::Create();
    actions->insert(action);
    mrpt::obs::CSensoryFrame::Ptr frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(observation_of(seen));
    processActionObservation(actions, frame);
  }

  std::span<const double> mean() const override {
    return {&m_xkk[0], static_cast<std::size_t>(m_xkk.size())};
  }
  double covariance(int row, int column) const override { return m_pkk(row, column); }
  int landmark_at(int place) const override {
    return static_cast<int>(m_IDs.inverse(static_cast<unsigned>(place)));
  }

 private:
  /// MRPT does not process motions before it has a landmark.
  void move_start(const mrpt::poses::CPosePDFGaussian& motion) {
    mrpt::poses::CPosePDFGaussian pose;
    getCurrentRobotPose(pose);
    pose += motion;
    for (unsigned i = 0; i < 3; ++i) m_xkk[static_cast<int>(i)] = pose.mean[i];
    m_pkk = pose.cov;
  }

  mrpt::obs::CObservationBearingRange::Ptr observation_of(std::span<const Sighting> seen) {
    auto observation = mrpt::obs::CObservationBearingRange::Create();
    observation->sensorLocationOnRobot = sensor_;
    observation->fieldOfView_yaw = static_cast<float>(2.0 * std::numbers::pi);
    for (const Sighting& sighting : seen) {
      // MRPT predicts only landmarks within the sensor's range. That range is set to the largest range so
      // far.
      reach_ = std::max(reach_, static_cast<float>(sighting.range));
      observation->sensedData.push_back({static_cast<float>(sighting.range),
                                         static_cast<float>(sighting.bearing),
                                         0.0F,
                                         sighting.landmark,
                                         {}});
    }
    observation->maxSensorDistance = reach_;
    return observation;
  }

  mrpt::poses::CPose3D sensor_;
  float reach_ = 0.0F;  // [m]
};

}  // namespace

/// The one function that this library shows.
__attribute__((visibility("default"))) std::unique_ptr<MrptFilter> make_mrpt_filter(const MrptSetup& setup) {
  return std::make_unique<Filter>(setup);
}

}  // namespace peers
