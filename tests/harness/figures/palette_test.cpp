#include "harness/figures/palette.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>

#include "harness/estimators/registry.hpp"
#include "harness/fixtures.hpp"

namespace harness {
namespace {

/// The difference of two colours. [-] of 255 for each channel
double distance(Rgb a, Rgb b) {
  const auto channel = [](Rgb colour, int shift) { return static_cast<double>((colour >> shift) & 0xFFU); };
  double sum = 0;
  for (const int shift : {0, 8, 16}) sum += std::pow(channel(a, shift) - channel(b, shift), 2);
  return std::sqrt(sum);
}

TEST(Palette, GivesEachRegisteredEstimatorAColourOfItsOwn) {
  std::map<std::string, Rgb> taken = {{"truth", palette::truth}, {"odometry", palette::odometry}};
  const seif::Registry registry = known_estimators();
  for (const seif::EstimatorType& type : registry.types()) {
    const Rgb colour = colour_of_estimator(type.name);
    for (const auto& [other, its_colour] : taken)
      EXPECT_GT(distance(colour, its_colour), 60) << type.name << " and " << other;
    taken.emplace(type.name, colour);
  }
  EXPECT_EQ(taken.size(), registry.types().size() + 2);
}

TEST(Palette, GivesOtherEstimatorsWhatIsLeft) {
  std::set<Rgb> own;
  const seif::Registry registry = known_estimators();
  for (const seif::EstimatorType& type : registry.types()) own.insert(colour_of_estimator(type.name));
  std::set<Rgb> shared;
  for (const char* name : {"", "mine", "fast_slam", "graph", "ukf", "a", "b", "c", "d", "e", "f", "g"}) {
    EXPECT_EQ(own.count(colour_of_estimator(name)), 0U) << name;
    EXPECT_EQ(colour_of_estimator(name), colour_of_estimator(name));
    shared.insert(colour_of_estimator(name));
  }
  EXPECT_GT(shared.size(), 1U);
}

TEST(Palette, IsThatOfThePlots) {
  const std::string script = test::read_file(SEIFBED_SOURCE_DIR "/docs/plot_run.gp");
  const std::string colours = fmt::format(
      R"(estimator eq "ekf" ? "#{:06X}" : estimator eq "seif" ? "#{:06X}" : "#{:06X}")",
      colour_of_estimator("ekf"), colour_of_estimator("seif"), colour_of_estimator("seif_report"));
  EXPECT_NE(script.find(colours), std::string::npos) << colours;
}

}  // namespace
}  // namespace harness
