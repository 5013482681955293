#include <string>
#include <string_view>
#include <vector>

#include "archive.hpp"
#include "harness/files/bad_input.hpp"
#include "harness/recording/run_folder.hpp"
#include "harness/recording/unfinished.hpp"
#include "harness/score/details.hpp"
#include "harness/score/score_folder.hpp"
#include "harness/score/summary.hpp"
#include "targets.hpp"

namespace fuzz {

namespace {

template <class Step>
void refuse_or(const Step& step) {
  try {
    step();
  } catch (const harness::BadInput&) {
  }
}

}  // namespace

void read_run(std::string_view bytes) {
  const harness::TemporaryFolder folder;
  const harness::TemporaryFolder whole;
  unpack(bytes, folder.path());
  std::vector<std::string> names = {"seif"};
  refuse_or([&] {
    const harness::Summary summary = harness::read_summary(folder / "summary.json");
    names.clear();
    for (const harness::EstimatorScore& score : summary.score.estimators) names.push_back(score.name);
    harness::to_json(summary);
  });
  refuse_or([&] { harness::score_folder(folder.path(), names, 1.0); });
  refuse_or([&] { harness::details_board(harness::score_details(folder.path(), names, {})); });
  refuse_or([&] { harness::copy_whole_part(folder.path(), whole.path()); });
}

}  // namespace fuzz
