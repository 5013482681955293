// What was done to a run by hand, with its times: enough to do it again, to the bit.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "seif/registry.hpp"
#include "worlds/world.hpp"

namespace harness {

/// Holds the world that a run began with, and everything that was done since. An intervention that is added at a
/// time takes the place of everything that was to come after it.
class Script {
 public:
  /// `resolved` is the text of the world.
  Script(worlds::World world, std::string resolved, const seif::Registry& registry);

  /// The world with all that was done: a run of it repeats everything.
  const worlds::World& world() const { return world_; }

  /// Whether something was done, or is to come, later than `t` [s].
  bool goes_on_after(double t) const;
  /// Forgets it.
  void cut_after(double t);

  /// Adds a fault; `yaml` as in a world file. Throws BadInput that says what is wrong with it.
  const worlds::Fault& add_fault(const std::string& yaml);
  /// Forgets the fault that was added last.
  void take_back();
  /// Adds a silence that goes on until end_silence(), or ends the one that goes on.
  const worlds::Fault& begin_silence(worlds::FaultySensor sensor, double t);
  void end_silence(worlds::FaultySensor sensor, double t);
  /// Whether a silence that was begun by hand goes on.
  bool has_begun_silence(worlds::FaultySensor sensor) const;
  /// Adds a row of commands; one of the same time is replaced.
  void take_over(const worlds::Takeover& row);
  /// Adds a copy of an estimator with another value of an option, and returns its name. It runs from the beginning.
  /// Throws BadInput.
  std::string add_beside(const std::string& estimator, const std::string& option,
                         const seif::OptionValue& value);

  /// Writes world.yaml and takeover.csv, of a run that ends at `t` [s], to a folder.
  void write(const std::filesystem::path& folder, double t) const;

 private:
  struct Done {
    std::string yaml;  // as in a world file
    worlds::Fault fault;
  };

  void rebuild();

  const seif::Registry* registry_;
  worlds::World base_;
  std::string resolved_;  // of `base_`
  worlds::World world_;
  std::vector<Done> faults_;  // by hand
  std::vector<worlds::Takeover> takeover_;
  std::vector<worlds::EstimatorChoice> beside_;
};

}  // namespace harness
