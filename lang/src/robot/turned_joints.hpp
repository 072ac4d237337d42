/// `turns`: joints that turn without end, whatever the URDF says. Simulators that push a base about draw its
/// wheels `fixed`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "robot/robot_file.hpp"
#include "robot/urdf.hpp"
#include "robot/wheel_search.hpp"
#include "robot/xml_scan.hpp"
#include "zwang/lang/robot_draft.hpp"

namespace zwang::lang {

/// Makes them `continuous`. An <axis> of 0 0 0, as exporters write it to what does not move, is none.
void let_turn(const std::vector<std::string>& joints, std::vector<XmlElement>& elements);

/// Complains of names that are unknown.
void check_turning(const RobotFile& file, const Urdf& urdf, Diagnostics& diagnostics);

/// Lets the wheels turn that the URDF holds, and the swivels above them. Where other wheels turn, only those
/// that stand as they do on an axle of their own. Changes nothing where that makes no more wheels.
void turn_wheels(const std::filesystem::path& path, Urdf& urdf, DraftOptions& options, FoundWheels& found);

/// The section `turns` of a draft.
std::string turns_entry(const std::vector<std::string>& joints);

}  // namespace zwang::lang
