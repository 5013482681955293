#include "worlds/schema.hpp"

#include <fmt/format.h>

#include "harness/commands/commands.hpp"
#include "harness/estimators/estimator_schemas.hpp"

namespace harness {

void add_schema(CommandLine line) {
  CLI::App* command = line.app.add_subcommand("schema", "Print the JSON Schema of world files, for editors");
  command->footer(
      "Example:\n"
      "  seifbed schema > worlds.schema.json\n"
      "With the first line of a world file `# yaml-language-server: $schema=worlds.schema.json`,\n"
      "editors complete and check it.");
  command->callback([&registry = line.registry, &code = line.exit_code] {
    code = guarded([&] {
      fmt::print("{}\n", worlds::json_schema(estimator_schemas(registry)));
      return 0;
    });
  });
}

}  // namespace harness
