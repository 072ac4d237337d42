// The inputs that a swapped-in program reads from the snapshots, and the reasons to refuse it.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../temporary_folder.hpp"
#include "constants.hpp"
#include "shipped_program.hpp"
#include "zwang/runtime/recorder.hpp"
#include "zwang/runtime/replay.hpp"
#include "zwang/runtime/runner.hpp"

namespace zwang::runtime {
namespace {

using lang::SignalType;
using std::string_literals::operator""s;
using zwang::test::shipped_program;

/// Drives on, and reads signals of these names and types, seen from the base.
lang::Program reading(const std::vector<std::pair<std::string, lang::SignalType>>& signals,
                      const std::string& frame = "base_link") {
  lang::Program program = shipped_program("obstacle.yaml", "mecanum");
  for (const auto& [name, type] : signals) {
    lang::Signal signal;
    signal.name = name;
    signal.type = type;
    signal.stale_after.constant = 1.0;
    while (program.frames[static_cast<std::size_t>(signal.in)].name != frame) ++signal.in;
    program.signals.push_back(signal);
  }
  return program;
}

/// The snapshots keep the layout of the first program. The next program finds its signals by name, in any
/// order, and leaves out the others. Both logs replay together.
TEST(HotReload, FindsItsSignalsByName) {
  const lang::Program first =
      reading({{"range", SignalType::number}, {"latch", SignalType::boolean}, {"felt", SignalType::wrench}});
  const lang::Program second = reading({{"felt", SignalType::wrench}, {"range", SignalType::number}});
  const zwang::test::TemporaryFolder folder;
  const auto log_to = [&](Runner& runner, const char* name) {
    std::vector<std::unique_ptr<LogSink>> sinks;
    sinks.push_back(mcap_sink(folder.path() / name, {}));
    auto recorder = std::make_unique<Recorder>(std::move(sinks), runner.columns());
    runner.record_to(recorder.get());
    return recorder;
  };
  Runner runner(first, {.period = period}), next(second, {.period = period});
  auto log = log_to(runner, "a.mcap");
  Sensed sensed(first);
  const auto step = [&](int tick) {
    sensed.time = tick * period;
    for (SignalSample& sample : sensed.signals) {
      sample.valid = true;
      sample.stamp = sensed.time;
    }
    sensed.signals[0].number = 0.5 + sensed.time;
    sensed.signals[2].wrench.linear.x() = 3.0;
    if (log) log->wait_for_room();
    runner.step(sensed);
  };
  for (int i = 0; i < 50; ++i) step(i);
  log->close();
  ASSERT_TRUE(runner.swap_program(next));
  log = log_to(runner, "b.mcap");
  for (int i = 50; i < 100; ++i) step(i);
  log->close();
  EXPECT_TRUE(runner.scheduler().signal_known(0) && runner.scheduler().signal_known(1));
  EXPECT_EQ(runner.scheduler().signal_sample(0).wrench.linear.x(), 3.0);
  EXPECT_EQ(runner.scheduler().signal_sample(1).number, 0.5 + 99 * period);
  EXPECT_EQ(runner.event_count(), 0U);
  const ReplayResult replayed =
      replay({{folder.path() / "a.mcap", first}, {folder.path() / "b.mcap", second}}, {.period = period});
  EXPECT_EQ(replayed.records, 100U);
  EXPECT_EQ(replayed.equal, 100U);
}

TEST(HotReload, RefusesSignalsThatNobodyMeasuresForIt) {
  const lang::Program first = reading({{"range", SignalType::number}, {"felt", SignalType::wrench}});
  const auto refused = [&](const lang::Program& program) {
    Runner runner(first, {.period = period}), next(program, {.period = period});
    const SwapResult result = runner.swap_program(next);
    EXPECT_FALSE(result);
    EXPECT_EQ(runner.step(Sensed(first)).size(), 4) << "the old program goes on";
    return std::pair{result.refusal, describe(result)};
  };
  EXPECT_EQ(refused(reading({{"latch", SignalType::boolean}})),
            (std::pair{SwapRefusal::signal_missing, describe(SwapRefusal::signal_missing) + ": `latch`"s}));
  EXPECT_EQ(refused(reading({{"range", SignalType::boolean}})).first, SwapRefusal::signal_type);
  EXPECT_EQ(refused(reading({{"felt", SignalType::wrench}}, "world")).first, SwapRefusal::signal_frame);
}

/// A host that lays its snapshots out for the next program, and one that fills in another type.
TEST(HotReload, SamplesThatAreNotLaidOutForTheSignalsAreNotTaken) {
  const lang::Program first = reading({{"range", SignalType::number}, {"latch", SignalType::boolean}});
  const lang::Program second = reading({{"latch", SignalType::boolean}});
  for (const bool resizes : {true, false}) {
    Runner runner(first, {.period = period}), next(second, {.period = period});
    ASSERT_TRUE(runner.swap_program(next));
    Sensed sensed(first);
    if (resizes) sensed = Sensed(second);
    SignalSample& sample = resizes ? sensed.signals[0] : sensed.signals[1];
    if (!resizes) sample.type = SignalType::number;
    for (int i = 0; i < 50; ++i) {
      sensed.time = sample.stamp = i * period;
      sample.valid = sample.boolean = true;
      runner.step(sensed);
    }
    EXPECT_FALSE(runner.scheduler().signal_known(0));
    ASSERT_EQ(runner.event_count(), 1U);
    EXPECT_EQ(runner.events()[0].code, EventCode::signal_refused);
    EXPECT_EQ(runner.event_signal(runner.events()[0]), resizes ? "" : "signal.latch");
    EXPECT_EQ(runner.events()[0].value, resizes ? 1.0 : 0.0);
  }
}

}  // namespace
}  // namespace zwang::runtime
