#include "worlds/schema.hpp"

#include <fmt/format.h>

#include <memory>

#include "harness/commands/commands.hpp"
#include "harness/estimators/estimator_schemas.hpp"
#include "worlds/key_tables.hpp"

namespace harness {
namespace {

constexpr const char* keys_page_head =
    "# The keys of world files\n"
    "\n"
    "`seifbed schema --markdown` writes this page; a test holds it to the program. How to write a world "
    "file: "
    "[README.md](README.md).\n"
    "\n"
    "`a.b` is key `b` in section `a`; `a[]` is an entry of the list `a`; `a.NAME` is a section with a name "
    "of "
    "your own. A key without a default is optional unless it is *required*. SI units stand at the end of the "
    "keys; angles are in degrees.\n"
    "\n";

int print_schema(const seif::Registry& registry, bool as_markdown) {
  const worlds::EstimatorSchemas schemas = estimator_schemas(registry);
  if (as_markdown) {
    return print_all(keys_page_head + worlds::key_tables(schemas), 0);
  }
  return print_all(worlds::json_schema(schemas) + '\n', 0);
}

}  // namespace

void add_schema(CommandLine line) {
  CLI::App* command = line.app.add_subcommand("schema", "Print the JSON Schema of world files, for editors");
  const auto as_markdown = std::make_shared<bool>(false);
  command->add_flag("--markdown", *as_markdown,
                    "Print tables of all keys instead, as worlds/keys.md holds them");
  command->footer(
      "Example:\n"
      "  seifbed schema > worlds.schema.json\n"
      "With the first line of a world file `# yaml-language-server: $schema=worlds.schema.json`,\n"
      "editors complete and check it.");
  command->callback([as_markdown, &registry = line.registry, &code = line.exit_code] {
    code = guarded([&] { return print_schema(registry, *as_markdown); });
  });
}

}  // namespace harness
