/// Checks on the text of a URDF, before its library reads it and beside it: the library accepts nearly
/// everything.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "robot/xml_scan.hpp"

namespace zwang::lang {

struct UrdfFindings {
  std::set<std::string> point_masses;  ///< links whose inertia no body has, too light for it to matter
  std::set<std::string> weightless;    ///< links with less mass than dust, which count as none
};

/// Numbers readable and finite, macros expanded, links and joints named and of known types, masses and
/// inertias possible, axes and limits usable, one tree. Writes what is wrong; nullopt when anything is.
std::optional<UrdfFindings> check_urdf(const std::vector<XmlElement>& elements, Diagnostics& diagnostics);

}  // namespace zwang::lang
