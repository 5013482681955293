// The module seifbed._seifbed: what the Python package seifbed is made of.
#include <pybind11/stl/filesystem.h>

#include <stdexcept>

#include "harness/estimators/plugins.hpp"
#include "harness/estimators/registry.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/terminal/version.hpp"
#include "python/bindings.hpp"
#include "python/long_call.hpp"
#include "seif/estimator.hpp"

namespace seifbed {

seif::Registry& known_registry() {
  static seif::Registry registry = [] {
    seif::Registry known = harness::known_estimators();
    harness::add_plugins_of_environment(known);
    return known;
  }();
  return registry;
}

}  // namespace seifbed

PYBIND11_MODULE(_seifbed, module) {
  namespace py = pybind11;
  module.doc() = "The compiled part of seifbed. Use the package seifbed instead.";
  module.attr("__version__") = std::string(harness::program_version());
  py::register_exception<harness::BadInput>(module, "BadInput", PyExc_ValueError);
  py::register_exception<seif::NumericalFailure>(module, "NumericalFailure", PyExc_ArithmeticError);
  seifbed::bind_measurements(module);
  seifbed::bind_filter(module);
  seifbed::bind_environment(module);
  seifbed::bind_scores(module);
  seifbed::bind_runs(module);
  module.def("end_calls", &seifbed::end_calls);
}
