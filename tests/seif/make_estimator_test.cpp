// Estimators by name, as a program of its own makes them: defaults, options, and what is refused.
#include "seif/make_estimator.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <variant>

#include "seif/ring_drive.hpp"

namespace seif {
namespace {

/// The message of the error, or "" if there is none.
template <class Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

std::string error_of_options(const std::string& name, const Options& chosen) {
  return error_of([&] { static_cast<void>(complete_options(*standard_estimators().find(name), chosen)); });
}

TEST(MakeEstimator, MakesEveryTypeWithItsDefaults) {
  const Registry registry = standard_estimators();
  for (const EstimatorType& type : registry.types()) {
    SCOPED_TRACE(type.name);
    test::RingDrive drive(20, 1);
    const auto filter = make_estimator(registry, type.name, drive.setup());
    for (int k = 0; k < 20; ++k) drive.step(*filter);
    EXPECT_LT(drive.error_of(filter->pose()).norm(), 0.5);
  }
}

TEST(MakeEstimator, ChosenOptionsTakeThePlaceOfDefaults) {
  const EstimatorType type = *standard_estimators().find("seif");
  const Options options = complete_options(type, {{"theta_x", std::int64_t{9}}, {"gate", std::int64_t{14}}});
  EXPECT_EQ(options.size(), type.options.size());
  EXPECT_EQ(option<std::int64_t>(options, "theta_x"), 9);
  EXPECT_EQ(option<double>(options, "gate"), 14.0);  // an integer is a number
  EXPECT_EQ(option<std::int64_t>(options, "theta_max"), 16);
}

TEST(MakeEstimator, RefusesWhatIsNotValid) {
  EXPECT_EQ(error_of_options("ekf", {{"gait", 1.0}}).substr(0, 31), "ekf has no option 'gait'; it ha");
  EXPECT_EQ(error_of_options("seif", {{"theta_x", 6.5}}), "seif: 'theta_x' must be an integer, not 6.5");
  EXPECT_EQ(error_of_options("seif", {{"gate", std::string("high")}}),
            "seif: 'gate' must be a number, not high");
  EXPECT_EQ(error_of_options("seif", {{"gate", -1.0}}), "seif: 'gate' must be at least 0, not -1");
  EXPECT_EQ(error_of_options("seif", {{"gate", std::numeric_limits<double>::quiet_NaN()}}),
            "seif: 'gate' must be finite, not nan");
  EXPECT_EQ(error_of_options("seif", {{"theta_x", std::int64_t{1}}}),
            "seif: 'theta_x' must be at least 2 and at most 1000, not 1");
  EXPECT_EQ(error_of_options("seif", {{"theta_x", std::int64_t{20}}}),
            "seif: 'theta_x' must be at most 'theta_max', which is 16, not 20; set both");
  EXPECT_EQ(error_of_options("seif", {{"association", std::string("by_colour")}}),
            "seif: 'association' must be one of known, nearest, joint, not 'by_colour'");
}

TEST(MakeEstimator, NamesTheEstimatorsThereAre) {
  const test::RingDrive drive(20, 1);
  const std::string error =
      error_of([&] { static_cast<void>(make_estimator(standard_estimators(), "sief", drive.setup())); });
  EXPECT_EQ(error.substr(0, 41), "there is no estimator 'sief'; there are e");
}

}  // namespace
}  // namespace seif
