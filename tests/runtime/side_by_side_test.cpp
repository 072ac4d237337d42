// Files are loaded, and cells run, on threads side by side, as `zwang test` and hosts in Python do.
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <thread>
#include <vector>

#include "zwang/runtime/scenario_run.hpp"

namespace zwang::runtime {
namespace {

constexpr std::size_t cells_of_a_scenario = 4;

CellResult run_alone(std::size_t cell) {
  const std::filesystem::path file = ZWANG_SOURCE_DIR "/specs/scenarios/end_outside.yaml";
  lang::Diagnostics of_scenario, of_task;
  const auto scenario = lang::load_scenario(file, of_scenario);
  const auto run = lang::load_run(file, cell, of_scenario, of_task);
  if (!scenario || !run) throw std::runtime_error(file.string());
  return run_cell(*scenario, scenario->cells[cell], *run);
}

TEST(SideBySide, CellsEndAsTheyDoAlone) {
  std::vector<CellResult> beside(cells_of_a_scenario);
  std::vector<std::thread> threads;
  for (std::size_t cell = 0; cell < cells_of_a_scenario; ++cell)
    threads.emplace_back([&beside, cell] { beside[cell] = run_alone(cell); });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t cell = 0; cell < cells_of_a_scenario; ++cell) {
    const CellResult alone = run_alone(cell);
    EXPECT_EQ(beside[cell].outcome, "failed") << beside[cell].name;  // what the scenario expects
    EXPECT_EQ(beside[cell].simulated, alone.simulated) << alone.name;
    EXPECT_EQ(beside[cell].torque, alone.torque) << alone.name;
  }
}

}  // namespace
}  // namespace zwang::runtime
