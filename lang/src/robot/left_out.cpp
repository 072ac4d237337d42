#include "robot/left_out.hpp"

namespace zwang::lang {

namespace {

/// A joint as far as it can be read: nothing was checked yet.
struct Edge {
  std::string joint, parent, child;
};

std::string attribute_of(const XmlElement& element, const char* name) {
  const XmlAttribute* attribute = element.find(name);
  return attribute != nullptr ? attribute->value : "";
}

/// Of each element of the root that is a joint, by its index.
std::map<std::size_t, Edge> edges_of(const std::vector<XmlElement>& elements) {
  std::map<std::size_t, Edge> edges;
  for (std::size_t i = 1; i < elements.size(); ++i) {
    const XmlElement& element = elements[i];
    if (element.parent == 0 && element.name == "joint") edges[i].joint = attribute_of(element, "name");
    const auto edge = edges.find(static_cast<std::size_t>(element.parent));
    if (edge == edges.end()) continue;
    if (element.name == "parent") edge->second.parent = attribute_of(element, "link");
    if (element.name == "child") edge->second.child = attribute_of(element, "link");
  }
  return edges;
}

/// The link and all below it.
std::set<std::string> below(const std::string& link, const std::map<std::size_t, Edge>& edges) {
  std::set<std::string> links{link};
  for (bool is_growing = true; is_growing;) {
    is_growing = false;
    for (const auto& [i, edge] : edges)
      is_growing = (links.contains(edge.parent) && links.insert(edge.child).second) || is_growing;
  }
  return links;
}

}  // namespace

void erase_elements(const std::set<std::size_t>& gone, std::vector<XmlElement>& elements) {
  std::vector<int> place(elements.size(), -1);  // where an element is now; -1: nowhere
  std::vector<XmlElement> kept;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    XmlElement& element = elements[i];
    if (gone.contains(i) || (i > 0 && place[static_cast<std::size_t>(element.parent)] < 0)) continue;
    if (i > 0) element.parent = place[static_cast<std::size_t>(element.parent)];
    place[i] = static_cast<int>(kept.size());
    kept.push_back(std::move(element));
  }
  elements = std::move(kept);
}

LeftOut leave_out(const std::vector<std::string>& links, std::vector<XmlElement>& elements) {
  const std::map<std::size_t, Edge> edges = edges_of(elements);
  std::map<std::string, std::size_t> places;  // of links
  for (std::size_t i = 1; i < elements.size(); ++i) {
    if (elements[i].parent == 0 && elements[i].name == "link")
      places.emplace(attribute_of(elements[i], "name"), i);
  }
  LeftOut left_out;
  std::set<std::size_t> gone;
  for (const std::string& link : links) {
    if (!places.contains(link)) continue;
    const std::set<std::string> part = below(link, edges);
    bool is_root = true;
    for (const auto& [i, edge] : edges) is_root = is_root && edge.child != link;
    for (const std::string& name : part) {
      left_out.try_emplace(name, link);
      if (!is_root && places.contains(name)) gone.insert(places.at(name));
    }
    for (const auto& [i, edge] : edges) {
      if (!part.contains(edge.child)) continue;
      left_out.try_emplace(edge.joint, link);
      if (!is_root) gone.insert(i);
    }
  }
  erase_elements(gone, elements);
  return left_out;
}

}  // namespace zwang::lang
