/// Links that a robot file leaves out of its URDF are taken away before anything is asked of them.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "robot/xml_scan.hpp"

namespace zwang::lang {

/// Links and joints that went, by their names. Each has the link of the list that it hung on.
using LeftOut = std::map<std::string, std::string>;

/// Takes the links away, with all that hangs on them by joints. The URDF's root stays: without it there is no
/// robot.
LeftOut leave_out(const std::vector<std::string>& links, std::vector<XmlElement>& elements);

/// Takes elements of the root away, by their indices, with all inside them.
void erase_elements(const std::set<std::size_t>& gone, std::vector<XmlElement>& elements);

}  // namespace zwang::lang
