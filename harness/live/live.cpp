#include "harness/live/live.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include "harness/figures/piped_program.hpp"
#include "harness/live/live_page.hpp"
#include "harness/live/live_pages.hpp"
#include "harness/live/live_saver.hpp"
#include "harness/live/live_session.hpp"
#include "harness/live/live_setting.hpp"
#include "harness/terminal/interrupt.hpp"
#include "harness/terminal/messages.hpp"
#include "harness/web/request_check.hpp"

namespace harness {

namespace {

PageServerPlan server_plan(const LiveOptions& options, const std::string& title) {
  PageServerPlan plan;
  plan.address = options.address;
  plan.port = options.port;
  plan.html = live_page(title);
  return plan;
}

bool is_loopback(const std::string& address) { return address.starts_with("127.") || address == "::1"; }

/// Opens the user's browser, if this machine has a display. The address is printed anyway. Nobody waits for the
/// program that opens it: it may last as long as the browser.
void open_browser(const std::string& url) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  std::thread([url] {
    try {
      PipedProgram browser({"xdg-open", url});
      static_cast<void>(browser.finish());
    } catch (const std::exception&) {  // without xdg-open, one opens the address by hand
    }
  }).detach();
}

/// What the program is asked for goes to stdout: of a run that is looked at, that is its result.
void tell_address(const PageServer& server, const LiveOptions& options, bool is_result) {
  const std::string line = fmt::format("Open {}", server.url());
  if (is_result) {
    print_out(line + '\n');
    std::fflush(stdout);
  } else {
    tell(line);
  }
  if (!is_loopback(options.address))
    tell_warning(
        fmt::format("other machines can reach port {} at {}: who knows the token sees the run and takes "
                    "hold of it; nothing is encrypted",
                    server.port(), options.address));
  if (options.opens_browser) open_browser(server.url());
}

}  // namespace

void show_live(LiveSource source, const LiveOptions& options) {
  const InterruptGuard guard;
  LiveChannels channels;
  LivePages pages(channels);
  const std::string title = source.log ? source.log->path.filename().string() : source.world.name;
  LiveSaver saver(std::filesystem::read_symlink("/proc/self/exe"), "runs", channels.outbox);
  LiveSession session(std::move(source), channels,
                      {options.is_paused, options.speed,
                       [&saver](const SaveOrder& order, const Script& script) { saver.save(order, script); }},
                      InterruptGuard::flag());
  const PageServer server(server_plan(options, title), pages);
  tell_address(server, options, true);
  session.run();
}

/// The server comes last: it is destroyed before what its pages read.
class LiveOnlookers::Core final : public RunListener {
 public:
  Core(const worlds::World& world, const PreparedRun& run, const seif::Registry& registry,
       const LiveOptions& options)
      : pages_(channels_),
        observer_(world, true, {*run.believers, *run.log, channels_.snapshots, channels_.wish}, 1),
        log_(*run.log),
        server_(server_plan(options, world.name), pages_) {
    const LiveSubject subject{
        world,    true,
        log_,     *run.believers,
        registry, {false, false, "this run goes on by itself; seifbed live lets you take hold of one"}};
    channels_.outbox.set(std::make_shared<const LiveSetting>(live_setting(subject, world.duration, 1, 1)));
    status_.speed = std::numeric_limits<double>::infinity();
    if (!world.estimators.empty()) status_.watched = world.estimators.front().name;
    tell_address(server_, options, false);
  }

  void odometry(const OdometryEvent& event) override {
    observer_.odometry(event);
    look();
  }
  void scan(const ScanEvent& event) override { observer_.scan(event); }
  void dead_reckoning(double t, const seif::Pose2& pose) override { observer_.dead_reckoning(t, pose); }
  void update(std::size_t estimator, const UpdateRecord& record) override {
    observer_.update(estimator, record);
  }
  void consistency(std::size_t estimator, const ConsistencyRecord& record) override {
    observer_.consistency(estimator, record);
  }

 private:
  void look() {
    while (const std::optional<Request> request = channels_.requests.pop())
      channels_.outbox.send(
          {request->page, said(true, "this run can be watched, and not changed", request->seq)});
    observer_.publish_if_due(status_);
  }

  LiveChannels channels_;
  LivePages pages_;
  LiveObserver observer_;
  const LogDescription& log_;
  LiveStatus status_;
  PageServer server_;
};

LiveOnlookers::LiveOnlookers(const worlds::World& world, const PreparedRun& run,
                             const seif::Registry& registry, const LiveOptions& options)
    : core_(std::make_unique<Core>(world, run, registry, options)) {}

LiveOnlookers::~LiveOnlookers() = default;

RunListener& LiveOnlookers::listener() { return *core_; }

}  // namespace harness
