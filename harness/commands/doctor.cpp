#include <memory>
#include <string>

#include "harness/commands/commands.hpp"
#include "harness/doctor/diagnosis.hpp"
#include "harness/doctor/library_versions.hpp"
#include "harness/doctor/machine.hpp"
#include "harness/doctor/self_test.hpp"
#include "harness/terminal/messages.hpp"
#include "harness/terminal/version.hpp"

namespace harness {

namespace {

int examine(bool json, const seif::Registry& registry) {
  Diagnosis diagnosis;
  diagnosis.libraries.push_back({"seifbed", true, std::string(program_version())});
  for (const LibraryVersion& library : library_versions())
    diagnosis.libraries.push_back({std::string(library.name), true, std::string(library.version)});
  diagnosis.machine = look_at_machine();
  diagnosis.self_test = test_self(registry);
  if (json) {
    print_out(to_json(diagnosis));
  } else {
    print_board(diagnosis_board(diagnosis));
  }
  return is_well(diagnosis) ? 0 : 1;
}

}  // namespace

void add_doctor(CommandLine line) {
  CLI::App* command = line.app.add_subcommand(
      "doctor", "Say whether everything works here, and what to install for what does not");
  command->footer(
      "Examples:\n"
      "  seifbed doctor\n"
      "  seifbed doctor --json | jq .well\n"
      "Versions, what the machine has, and a self-test of physics, sensing, estimation and rendering, in "
      "less\n"
      "than ten seconds. Nothing is left behind. Exit code 0: all is well; 1: something is missing or "
      "wrong.");
  auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "Print it as JSON");
  command->callback([=, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return examine(*json, registry); });
  });
}

}  // namespace harness
