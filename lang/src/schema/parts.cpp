#include "schema/parts.hpp"

#include "zwang/lang/schema.hpp"

namespace zwang::lang {

namespace schema {

namespace {

/// A number, and a unit behind a space or none.
const char* const quantity_pattern =
    "^\\s*[+-]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?(\\s*[A-Za-z%][A-Za-z0-9 */^%-]*)?\\s*$";
const char* const parameter_pattern = "^-?\\$[A-Za-z_][A-Za-z0-9_]*$";
const char* const symmetric_pattern = "^\\+-\\s*(\\$[A-Za-z_]|[0-9.]).*$";

Json text_like(const char* pattern) {
  return {{"type", "string"}, {"pattern", pattern}};
}

Json described(Json schema, const char* description) {
  if (*description != '\0') schema["description"] = description;
  return schema;
}

}  // namespace

Json object(const char* description, std::vector<Property> properties) {
  Json schema = described({{"type", "object"}}, description);
  Json required = Json::array();
  Json all = Json::object();
  for (Property& property : properties) {
    if (property.is_required) required.push_back(property.name);
    all[property.name] = std::move(property.schema);
  }
  schema["properties"] = std::move(all);
  if (!required.empty()) schema["required"] = std::move(required);
  schema["additionalProperties"] = false;
  return schema;
}

Json named(const char* description, Json each) {
  Json schema = described({{"type", "object"}}, description);
  schema["additionalProperties"] = std::move(each);
  return schema;
}

Json list(const char* description, Json each) {
  Json schema = described({{"type", "array"}}, description);
  schema["items"] = std::move(each);
  return schema;
}

Json filled(Json schema) {
  schema[schema["type"] == "object" ? "minProperties" : "minItems"] = 1;
  return schema;
}

Json tuple(const char* description, Json each, int fewest, int most) {
  Json schema = list(description, std::move(each));
  schema["minItems"] = fewest;
  schema["maxItems"] = most;
  return schema;
}

Json any_of(std::vector<Json> choices) {
  return {{"anyOf", std::move(choices)}};
}

Json word(const char* description) {
  return described({{"type", "string"}}, description);
}

Json one_of_words(const char* description, std::vector<std::string> words) {
  return described({{"enum", std::move(words)}}, description);
}

Json certainty(const char* description) {
  Json schema = any_of({reference("quantity"), Json{{"type", "string"}, {"pattern", "^>= *[0-9.]+ *%$"}}});
  schema["description"] = description;
  return schema;
}

Json reference(const char* name, const char* description) {
  // Draft 7 reads nothing beside a $ref: the description goes around it.
  const Json bare = {{"$ref", std::string("#/definitions/") + name}};
  if (*description == '\0') return bare;
  return {{"description", description}, {"allOf", Json::array({bare})}};
}

Property version(const char* key, int newest) {
  Json schema = Json::object();
  if (newest == 1) {
    schema["const"] = 1;
  } else {
    for (int known = 1; known <= newest; ++known) schema["enum"].push_back(known);
  }
  schema["description"] = "the version of the language that the file is written in";
  return {key, std::move(schema), true};
}

Json definitions() {
  const Json number = {{"type", "number"}};
  Json all;
  all["quantity"] = any_of({number, text_like(quantity_pattern)});
  all["quantity"]["description"] = "a number and its unit, as `0.08 m/s`";
  all["value"] = any_of({reference("quantity"), text_like(parameter_pattern)});
  all["value"]["description"] = "a quantity, or a parameter as `$push` or `-$push`";
  all["range"] = any_of({tuple("", reference("value"), 2, 2), text_like(symmetric_pattern)});
  all["range"]["description"] = "`[low, high]`, or `+-value`";
  all["vector"] = tuple("lengths along x, y and z", reference("quantity"), 2, 3);
  all["point"] = tuple("lengths along x and y", reference("quantity"), 2, 2);
  all["polygon"] = list("corners, in the order in which one would walk around", reference("point"));
  all["polygon"]["minItems"] = 3;
  return all;
}

}  // namespace schema

std::string json_schema(FileKind kind) {
  schema::Json schema;
  switch (kind) {
    case FileKind::task:
      schema = schema::task_file();
      break;
    case FileKind::robot:
      schema = schema::robot_file();
      break;
    case FileKind::scene:
      schema = schema::scene_file();
      break;
    case FileKind::scenario:
      schema = schema::scenario_file();
      break;
    case FileKind::connection:
      schema = schema::connection_file();
      break;
    case FileKind::study:
      schema = schema::study_file();
      break;
  }
  schema::Json whole = {{"$schema", "http://json-schema.org/draft-07/schema#"}};
  whole.update(schema);
  schema::Json definitions = schema::definitions();
  if (whole.contains("definitions")) definitions.update(whole["definitions"]);
  whole["definitions"] = std::move(definitions);
  return whole.dump(2) + "\n";
}

}  // namespace zwang::lang
