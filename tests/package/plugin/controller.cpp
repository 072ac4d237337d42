#include <algorithm>
#include <exception>
#include <iostream>
#include <string_view>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/runner.hpp"
#include "zwang/version.hpp"

static_assert(std::string_view(ZWANG_VERSION) == FOUND_VERSION, "the headers are those of the package");
static_assert(ZWANG_VERSION_MAJOR == FOUND_MAJOR && ZWANG_VERSION_MINOR == FOUND_MINOR &&
              ZWANG_VERSION_PATCH == FOUND_PATCH);

/// Ten ticks of a task, of a robot that stands and does not answer. The largest torque that was asked for [N
/// m]; negative: it could not be loaded.
extern "C" double largest_torque_of_ten_ticks(const char* task) {
  using namespace zwang;
  try {
    lang::Diagnostics diagnostics;
    const auto program = lang::load(task, {}, diagnostics);
    if (!program) {
      lang::render_human(diagnostics, std::cerr);
      return -1.0;
    }
    runtime::Runner runner(*program);
    runtime::Sensed sensed(*program);
    sensed.base_measured = true;
    double largest = 0.0;
    for (int i = 0; i < 10; ++i) {
      largest = std::max(largest, runner.step(sensed).cwiseAbs().maxCoeff());
      sensed.time += runner.period();
    }
    return largest;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return -1.0;
  }
}
