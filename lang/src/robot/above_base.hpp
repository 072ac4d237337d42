/// The joints that a URDF draws between the world and a base. They describe the base's motion, which the
/// model of a base has by itself.
#pragma once

#include <string>
#include <vector>

#include "robot/xml_scan.hpp"

namespace zwang::lang {

struct AboveBase {
  std::vector<std::string> links;   ///< from the root on
  std::vector<std::string> joints;  ///< likewise
};

/// Takes away the links above the last `floating` or `planar` joint of the chain that begins at the root.
/// Takes away the chain's joints as far as that one, too. A link of the chain has a negligible mass and no
/// other joint below. The link below the last joint is the root then.
AboveBase drop_above_base(std::vector<XmlElement>& elements);

}  // namespace zwang::lang
