#include "edit/schema_walk.hpp"

#include <algorithm>
#include <array>

#include "schema/parts.hpp"

namespace zwang::lang {

namespace {

using schema::Json;

Json whole_schema(FileKind kind) {
  switch (kind) {
    case FileKind::task:
      return schema::task_file();
    case FileKind::robot:
      return schema::robot_file();
    case FileKind::scene:
      return schema::scene_file();
    case FileKind::scenario:
      return schema::scenario_file();
    case FileKind::study:
      return schema::study_file();
    case FileKind::connection:
      break;
  }
  return schema::connection_file();
}

/// The schemas are made once: a completion walks them with each letter.
const Json& schema_of(FileKind kind) {
  static const std::array<Json, 6> all = [] {
    std::array<Json, 6> made;
    for (std::size_t i = 0; i < made.size(); ++i) {
      made[i] = whole_schema(static_cast<FileKind>(i));
      Json definitions = schema::definitions();
      if (made[i].contains("definitions")) definitions.update(made[i]["definitions"]);
      made[i]["definitions"] = std::move(definitions);
    }
    return made;
  }();
  return all[static_cast<std::size_t>(kind)];
}

/// The choices that a schema leaves, references followed. The schema around a reference describes it.
class Choices {
 public:
  explicit Choices(const Json& root) : root_(&root) {}

  void add(const Json& schema, const std::string& about = {}) {
    const std::string own = schema.value("description", about);
    if (const auto reference = schema.find("$ref"); reference != schema.end()) {
      const std::string name = reference->get<std::string>();
      return add((*root_)["definitions"][name.substr(name.rfind('/') + 1)], own);
    }
    for (const char* key : {"anyOf", "allOf"}) {
      const auto choices = schema.find(key);
      if (choices == schema.end()) continue;
      for (const Json& choice : *choices) add(choice, own);
      return;
    }
    all.push_back({&schema, own});
  }

  struct Choice {
    const Json* schema;
    std::string about;
  };
  std::vector<Choice> all;

 private:
  const Json* root_;
};

/// One key deeper.
Choices below(const Choices& choices, const Json& root, const std::string& key) {
  Choices next(root);
  for (const auto& [schema, about] : choices.all) {
    if (key == "-") {
      if (schema->contains("items")) next.add((*schema)["items"]);
      continue;
    }
    const auto properties = schema->find("properties");
    if (properties != schema->end() && properties->contains(key)) {
      next.add((*properties)[key]);
    } else if (schema->contains("additionalProperties") && (*schema)["additionalProperties"].is_object()) {
      next.add((*schema)["additionalProperties"]);
    }
  }
  return next;
}

}  // namespace

namespace {

/// A line for each choice: what `free` means, and what statements are.
void add_about(const Json& word, const std::string& about, SchemaPlace& place) {
  if (about.empty() || place.about.find(about) != std::string::npos) return;
  if (!place.about.empty()) place.about += "  \n";
  if (word.is_string()) place.about += "`" + word.get<std::string>() + "`: ";
  place.about += about;
}

}  // namespace

SchemaPlace schema_place(FileKind kind, const std::vector<std::string>& keys) {
  const Json& root = schema_of(kind);
  Choices choices(root);
  choices.add(root);
  for (const std::string& key : keys) choices = below(choices, root, key);
  SchemaPlace place;
  for (const auto& [schema, about] : choices.all) {
    const auto words = schema->find("enum");
    add_about(words != schema->end() && choices.all.size() > 1 ? words->front() : Json(), about, place);
    if (words != schema->end()) {
      for (const Json& word : *words)
        place.words.push_back(word.is_string() ? word.get<std::string>() : word.dump());
    }
    if (schema->value("type", "") == "boolean") place.words.insert(place.words.end(), {"true", "false"});
    const auto properties = schema->find("properties");
    if (properties == schema->end()) continue;
    for (const auto& [name, property] : properties->items()) {
      const bool is_known = std::any_of(place.keys.begin(), place.keys.end(),
                                        [&n = name](const SchemaKey& key) { return key.name == n; });
      if (!is_known) place.keys.push_back({name, property.value("description", "")});
    }
  }
  return place;
}

}  // namespace zwang::lang
