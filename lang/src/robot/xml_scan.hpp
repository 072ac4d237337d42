/// A look at an XML text before the URDF library sees it: its elements with their places. Knows just enough
/// XML for URDF; what it does not know it refuses.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "zwang/lang/diagnostic.hpp"

namespace zwang::lang {

inline constexpr int deepest_element = 64;
inline constexpr std::size_t most_attributes = 64;  ///< of an element

struct XmlAttribute {
  std::string name;
  std::string value;
  Span span;  ///< of the value, quotes excluded
};

struct XmlElement {
  std::string name;
  int parent = -1;  ///< index; smaller than the own one
  std::vector<XmlAttribute> attributes;
  std::string text;  ///< between its tags, without spaces: no URDF has any, a simulator's tags have
  Span span;         ///< of `<name`

  const XmlAttribute* find(std::string_view attribute) const {
    for (const XmlAttribute& a : attributes) {
      if (a.name == attribute) return &a;
    }
    return nullptr;
  }
};

/// Every element in the order of the text; the first is the root. nullopt: zwang does not read this XML.
/// Reasons are its size, depth, attributes, UTF-8, DOCTYPE, or tags that do not match.
std::optional<std::vector<XmlElement>> scan_xml(int source, Diagnostics& diagnostics);

}  // namespace zwang::lang
