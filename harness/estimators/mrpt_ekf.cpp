#include "harness/estimators/mrpt_ekf.hpp"

#include <system_error>

#include "harness/estimators/plugins.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/peers/mrpt_ekf_type.hpp"

namespace harness {

std::filesystem::path peers_module() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path installed =
      program.parent_path().parent_path() / SEIFBED_INSTALLED_PEERS_MODULE;
  return std::filesystem::exists(installed, error) ? installed : SEIFBED_PEERS_MODULE;
}

seif::EstimatorType mrpt_ekf_estimator(const std::filesystem::path& module) {
  return peers::mrpt_ekf_type([module](const seif::EstimatorSetup& setup, const seif::Options& options) {
    if (!std::filesystem::exists(module))
      throw BadInput(
          "mrpt_ekf: this program was built without MRPT; SEIFBED_PEERS=1 ./seifbed installs it (on Debian "
          "libmrpt-slam-dev) and builds with it");
    return plugin_estimators(module).find("mrpt_ekf")->make(setup, options);
  });
}

}  // namespace harness
