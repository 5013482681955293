#include "harness/live/live_saver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "harness/figures/piped_program.hpp"
#include "harness/files/output_file.hpp"
#include "harness/live/message.hpp"
#include "harness/terminal/messages.hpp"
#include "worlds/limits.hpp"

namespace harness {

namespace {

using Json = nlohmann::ordered_json;

constexpr double filmed = 60.0;  // [s] of a film: the last minute

/// `{"kind":"saved",..}`
PageMessage saved_message(const SaveOrder& order, const std::string& path, const std::string& text) {
  const Json json = {{"kind", "saved"}, {"what", order.what}, {"path", path},
                     {"text", text},    {"url", nullptr},     {"seq", order.seq}};
  PageMessage message;
  write_message(json.dump(-1, ' ', false, Json::error_handler_t::replace), {}, message);
  return message;
}

/// The options before the command that this program was called with.
std::vector<std::string> limits_option() {
  const double factor =
      static_cast<double>(worlds::limits().values) / static_cast<double>(worlds::Limits{}.values);
  if (factor == 1.0) return {};
  return {"--limits", fmt::format("{}", factor)};
}

}  // namespace

LiveSaver::LiveSaver(std::filesystem::path program, std::filesystem::path folder, Outbox& outbox)
    : program_(std::move(program)),
      folder_(std::move(folder)),
      outbox_(outbox),
      thread_([this] { work(); }) {}

LiveSaver::~LiveSaver() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
  }
  came_.notify_one();
  thread_.join();
}

void LiveSaver::save(const SaveOrder& order, const Script& script) {
  Job job{order, std::make_unique<TemporaryFolder>()};
  script.write(job.script->path(), order.t);
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  came_.notify_one();
}

void LiveSaver::work() {
  while (true) {
    Job job;
    {
      std::unique_lock lock(mutex_);
      came_.wait(lock, [this] { return is_over_ || !jobs_.empty(); });
      if (is_over_) return;
      job = std::move(jobs_.front());
      jobs_.pop_front();
    }
    try {
      carry_out(job);
    } catch (const std::exception& error) {
      outbox_.send({job.order.page, said(true, fmt::format("not saved: {}", error.what()), job.order.seq)});
    }
  }
}

void LiveSaver::call(const std::vector<std::string>& arguments) const {
  std::vector<std::string> words = {program_.string()};
  for (std::string& word : limits_option()) words.push_back(std::move(word));
  words.insert(words.end(), arguments.begin(), arguments.end());
  PipedProgram program(words);
  if (!program.finish())
    throw std::runtime_error(program.complaint().empty() ? "the program failed" : program.complaint());
}

void LiveSaver::carry_out(const Job& job) {
  const SaveOrder& order = job.order;
  const std::filesystem::path run = create_run_folder(folder_, file_name_of(order.world) + "-live");
  call({"run", (*job.script / "world.yaml").string(), "--out", run.string(), "--quiet"});
  const Json summary = Json::parse(read_whole_file(run / "summary.json"));
  if (summary.at("trajectory_hash") != order.hash)
    throw std::runtime_error(
        fmt::format("{} has other bits than what was seen: this is an error of the program", run.string()));
  std::filesystem::path result = run;
  if (order.what == "film") {
    result = run / "film.mp4";
    call({"film", run.string(), "--from", fmt::format("{}", std::max(0.0, order.t - filmed)), "--quiet",
          "--out", result.string()});
  } else if (order.what == "report") {
    result = run / "report.html";
    call({"report", run.string(), "--out", result.string()});
  }
  const std::string text =
      fmt::format("saved to {}; run again from its world file, it had the same bits (trajectory hash {})",
                  result.string(), order.hash);
  tell(text);
  outbox_.send({order.page, saved_message(order, result.string(), text)});
}

}  // namespace harness
