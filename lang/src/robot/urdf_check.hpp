/// What is checked on a URDF's own words before and beside its library, which accepts nearly everything.
#pragma once

#include <vector>

#include "robot/xml_scan.hpp"

namespace zwang::lang {

/// Numbers readable and finite, macros expanded, links and joints named and of known types, masses and
/// inertias possible, axes and limits usable, one tree. Writes what is wrong; false when anything is.
bool check_urdf(const std::vector<XmlElement>& elements, Diagnostics& diagnostics);

}  // namespace zwang::lang
