/// Of a URDF, what makes a robot move: the URDF library is shown no more, so that it refuses no robot for its
/// paint.
#pragma once

#include <string>
#include <vector>

#include "robot/xml_scan.hpp"

namespace zwang::lang {

/// A URDF of the same robot: its links with mass, inertia, boxes, cylinders and spheres, its joints with axis
/// and limits. The elements were checked.
std::string urdf_excerpt(const std::vector<XmlElement>& elements);

}  // namespace zwang::lang
