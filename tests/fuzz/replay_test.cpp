// Replays every interesting input that a fuzzer has found, and every input that once broke something.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

#include "targets.hpp"

namespace fuzz {
namespace {

namespace fs = std::filesystem;

class Corpus : public testing::TestWithParam<std::string_view> {};
INSTANTIATE_TEST_SUITE_P(Of, Corpus, testing::Values("worlds", "overrides", "logs", "runs", "requests"),
                         [](const auto& corpus) { return std::string(corpus.param); });

/// A target that finds an error ends the program.
TEST_P(Corpus, BreaksNothing) {
  int inputs = 0;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(fs::path(SEIFBED_SOURCE_DIR) / "tests/fuzz/corpus" / GetParam())) {
    SCOPED_TRACE(entry.path().string());
    std::ifstream file(entry.path(), std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    EXPECT_NO_THROW(targets().at(GetParam())(bytes.str()));
    ++inputs;
  }
  EXPECT_GE(inputs, 10);
}

TEST_P(Corpus, IsSmall) {
  std::uintmax_t bytes = 0;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(fs::path(SEIFBED_SOURCE_DIR) / "tests/fuzz/corpus" / GetParam()))
    bytes += entry.file_size();
  EXPECT_LE(bytes, 75'000U);
}

}  // namespace
}  // namespace fuzz
