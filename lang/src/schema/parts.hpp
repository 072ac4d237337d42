/// The parts from which the schemas of all files are built.
#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace zwang::lang::schema {

using Json = nlohmann::ordered_json;

struct Property {
  const char* name;
  Json schema;
  bool is_required = false;
};

/// A map with these keys and no others.
Json object(const char* description, std::vector<Property> properties);
/// A map whose keys are the author's names.
Json named(const char* description, Json each);
Json list(const char* description, Json each);
/// The list or the mapping, which may not be empty.
Json filled(Json schema);
/// Exactly so many of them.
Json tuple(const char* description, Json each, int fewest, int most);
Json any_of(std::vector<Json> choices);
Json word(const char* description);
Json one_of_words(const char* description, std::vector<std::string> words);
Json reference(const char* name, const char* description = "");
/// A share of runs: `99.9 %`, or `>= 99.9 %` in quotes.
Json certainty(const char* description);
/// The definitions that `reference` can name: text, quantity, value, range, vector, pose.
Json definitions();
/// `key: 1`
Property version(const char* key, int newest = 1);

Json task_file();
Json robot_file();
Json scene_file();
Json scenario_file();
Json connection_file();
Json study_file();

}  // namespace zwang::lang::schema
