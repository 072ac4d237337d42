#include "plant_start.hpp"

#include <stdexcept>
#include <string>

#include "zwang/lang/plant_refusal.hpp"
#include "zwang/runtime/mujoco_plant.hpp"

namespace zwang::cli {

namespace {

/// Without the word that says who speaks.
std::string reason_of(const std::invalid_argument& refusal) {
  std::string reason = refusal.what();
  for (const char* speaker : {"plant: ", "scene: "}) {
    if (reason.starts_with(speaker)) reason.erase(0, std::string(speaker).size());
  }
  return reason;
}

}  // namespace

runtime::ScenePlantOptions plant_options(const lang::Program& program) {
  runtime::ScenePlantOptions options;
  options.simulation.period = runtime::SimulationSteps(program.robot.control_period).period();
  return options;
}

std::unique_ptr<runtime::ScenePlant> start_plant(const lang::Program& program,
                                                 const runtime::ScenePlantOptions& options,
                                                 lang::Diagnostics& diagnostics) {
  try {
    return std::make_unique<runtime::ScenePlant>(program, options);
  } catch (const std::invalid_argument& refusal) {
    lang::tell_plant_refusal(reason_of(refusal), program.robot, &*program.scene, diagnostics);
    return nullptr;
  }
}

void check_plant(const lang::Robot& robot, lang::Diagnostics& diagnostics) {
  try {
    const runtime::MujocoPlant plant(robot, lang::Scene{});
  } catch (const std::invalid_argument& refusal) {
    lang::tell_plant_refusal(reason_of(refusal), robot, nullptr, diagnostics);
  }
}

void check_plant(const lang::Program& program, lang::Diagnostics& diagnostics) {
  if (program.scene) start_plant(program, plant_options(program), diagnostics);
}

}  // namespace zwang::cli
