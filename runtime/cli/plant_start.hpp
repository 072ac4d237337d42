/// The simulated plant of a file, or the diagnostic of its failure. `validate` checks the plant that `run`
/// will need.
#pragma once

#include <memory>

#include "zwang/lang/program.hpp"
#include "zwang/runtime/scene_plant.hpp"

namespace zwang::cli {

/// Of a program with a scene; nullptr, and E915, where the plant refuses it. The plant keeps the program.
std::unique_ptr<runtime::ScenePlant> start_plant(const lang::Program& program,
                                                 const runtime::ScenePlantOptions& options,
                                                 lang::Diagnostics& diagnostics);
/// With the program's control period and nothing else.
runtime::ScenePlantOptions plant_options(const lang::Program& program);

/// E915 where the plant refuses the robot on an empty floor.
void check_plant(const lang::Robot& robot, lang::Diagnostics& diagnostics);
/// E915 where the plant refuses the robot in its scene; nothing without a scene.
void check_plant(const lang::Program& program, lang::Diagnostics& diagnostics);

}  // namespace zwang::cli
