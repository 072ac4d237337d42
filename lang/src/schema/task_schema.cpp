#include "schema/parts.hpp"
#include "spec/shape.hpp"

namespace zwang::lang::schema {

namespace {

/// The schema of a statement about one of an axis's four quantities.
Json statement(const char* description, std::vector<Json> more = {}) {
  std::vector<Json> choices = {reference("value"), reference("range"),
                               word("the name of a signal of the type number")};
  choices.insert(choices.end(), more.begin(), more.end());
  Json schema = any_of(std::move(choices));
  schema["description"] = description;
  return schema;
}

std::vector<Property> manner() {
  return {
      {"time_constant",
       reference("value",
                 "how fast a driver gets there: it has made 63 % of a velocity step after this time")},
      {"level", Json{{"type", "integer"},
                     {"minimum", 0},
                     {"maximum", 9},
                     {"description", "a lower number goes first, strictly; 0 under `always` only"}}},
      {"weight",
       reference("value", "a mass w that makes rows soft: they meet the share w / (w + effective mass)")}};
}

Property way_back() {
  return {"return", reference("value",
                              "how fast it comes back from outside of a position range; 0: not at "
                              "all; where none is given, 0.1 m/s or 0.1 rad/s")};
}

std::vector<Property> statements() {
  std::vector<Property> properties = {
      {"position",
       statement("a single value drives there; a range keeps inside", {one_of_words("", {"here"})})},
      {"velocity", statement("a single value drives at this velocity; a range limits it")},
      {"acceleration", statement("a single value drives with this acceleration; a range limits it")},
      {"force", statement("a single value drives with this force; a range beside a driver of motion limits "
                          "the force that it spends")},
      {"stiffness", reference("value", "with `damping`: a position driver becomes a spring")},
      {"damping", reference("value", "with `stiffness` or `yield`")},
      {"yield",
       word("drives: gives way to this force like a mass with a damper; `felt.x`, `estimated.force.x`")},
      {"mass", reference("value", "with `yield`: the mass that it feels like")},
      {"dead_band", reference("value", "with `yield`: a force below moves nothing; default 0")},
      {"build_up", reference("value",
                             "of a position or a velocity: the time in which its error is added once "
                             "more, until it is gone")},
      way_back()};
  for (Property& property : manner()) properties.push_back(std::move(property));
  return properties;
}

Json axis() {
  return any_of({one_of_words("no statement; conditions can measure the axis", {"free"}),
                 filled(object("a single value drives, a range limits", statements()))});
}

/// Its further keys replace those of the template: they may be those of any group.
Json group_use() {
  Json use = object("a template's group; further keys replace the template's",
                    {{"use", word("the name of a template with a `group`"), true},
                     {"with", named("its arguments", any_of({reference("value"), word("a name")}))}});
  use.erase("additionalProperties");
  return use;
}

Json group() {
  std::vector<Property> axes = {{"move", word("the frame that moves"), true},
                                {"in", word("the frame whose axes count, or a path"), true}};
  for (Property& property : manner()) axes.push_back(std::move(property));
  axes.push_back(way_back());
  for (const char* name : {"x", "y", "z", "rx", "ry", "rz"}) axes.push_back({name, reference("axis")});
  std::vector<Property> speed = {{"velocity", reference("range"), true}};
  for (Property& property : manner()) speed.push_back(std::move(property));
  axes.push_back({"speed", object("the norm of the velocity in the plane", std::move(speed))});
  std::vector<Property> plane = {{"velocity", reference("range", "of the norm: begins at 0 m/s")},
                                 {"acceleration", reference("range", "of the point's, whatever turns it")},
                                 {"force", reference("range", "on a wall across any direction")}};
  for (Property& property : manner()) plane.push_back(std::move(property));
  axes.push_back({"plane", filled(object("norms in the plane of x and y", std::move(plane)))});
  std::vector<Property> feature = {{"feature", word("the name of a feature"), true}};
  for (Property& property : statements()) feature.push_back(std::move(property));
  return any_of({object("statements about the axes of a frame", std::move(axes)),
                 object("keeps a frame or the footprint inside a region",
                        {{"move", word("a frame, or `footprint`"), true},
                         {"inside", word("the name of a region"), true},
                         {"margin", reference("value", "the distance kept from the border")},
                         way_back(),
                         {"level", Json{{"type", "integer"}, {"minimum", 0}, {"maximum", 9}}}}),
                 object("statements about a feature", std::move(feature)), group_use()});
}

/// A truth value is one of YAML's own.
Json output_value() {
  return any_of({Json{{"type", "boolean"}}, reference("value")});
}

Json outputs() {
  return named(
      "what tasks set beside motion: a gripper, a lamp",
      object("", {{"type", one_of_words("", {"bool", "number"}), true},
                  {"unit", word("of a number")},
                  {"start", output_value()},
                  {"stop", any_of({one_of_words("it stays what it is", {"keep"}), output_value()}), true}}));
}

Json set() {
  Json schema = {{"type", "object"},
                 {"description", "frames.NAME: frame, params.NAME: value, outputs.NAME: value"}};
  schema["patternProperties"] = {{"^frames\\.[A-Za-z_]\\w*$", word("the frame whose pose it takes")},
                                 {"^params\\.[A-Za-z_]\\w*$", reference("value")},
                                 {"^outputs\\.[A-Za-z_]\\w*$", output_value()}};
  schema["additionalProperties"] = false;
  return schema;
}

Json leads_to(const char* description) {
  return word(description);
}

Json exit() {
  return object(
      "", {{"when", reference("condition"), true},
           {"for", reference("value", "how long the condition must hold without a break")},
           {"release",
            reference("value", "once true, the comparison stays true until its left side passes this value")},
           {"goto", leads_to("a task, `done`, `failed`, or `back`"), true},
           {"set", reference("set")},
           {"note", word("why, for reports and the log")}});
}

std::vector<Property> task_keys() {
  return {{"about", word("a sentence for reports")},
          {"enter", object("on entry", {{"require", reference("condition", "false on entry: `failed`")},
                                        {"blend", reference("value", "how long the switch takes")},
                                        {"set", reference("set")}})},
          {"constraints", named("groups by their names", reference("group"))},
          {"exits", list("evaluated from top to bottom; the first true exit fires", reference("exit"))},
          {"timeout",
           any_of({one_of_words("the task may run for ever", {"never"}),
                   object("", {{"after", reference("value"), true},
                               {"goto",
                                leads_to("a task, `done`, `failed`; `back` in a task that interrupts"), true},
                               {"note", word("why, for reports and the log")}})})},
          {"attempts", object("how often the task may be entered",
                              {{"max", Json{{"type", "integer"}, {"minimum", 1}}, true},
                               {"goto", leads_to("where entry max + 1 leads instead"), true},
                               {"note", word("why, for reports and the log")}})}};
}

Json task_use() {
  std::vector<Property> keys = {
      {"use", word("the name of a template"), true},
      {"with", named("its arguments", any_of({reference("value"), word("a name")}))}};
  for (Property& property : task_keys()) keys.push_back(std::move(property));
  return object("a template's task; further keys replace the template's", std::move(keys));
}

Json parameters() {
  return named(
      "values that can be set for one run, as `-p push=30N`",
      any_of({reference("quantity"), object("", {{"value", reference("quantity"), true},
                                                 {"range", reference("range", "the values that it may take")},
                                                 {"help", word("a sentence for the person who sets it")}})}));
}

Json frames() {
  return named(
      "places with axes",
      object("", {{"parent", word("`world`, a frame of the robot, another frame, or a pose signal"), true},
                  {"at", reference("vector", "the origin, in the parent")},
                  {"yaw", reference("quantity", "the heading, in the parent")},
                  {"rpy", tuple("roll, pitch and yaw, in the parent", reference("quantity"), 3, 3)}}));
}

Json regions() {
  const Json circle = object("", {{"at", reference("point"), true}, {"radius", reference("quantity"), true}});
  return named("stretches of floor", object("", {{"polygon", reference("polygon")},
                                                 {"circle", circle},
                                                 {"parent", word("a frame; default `world`")}}));
}

Json paths() {
  Json points = list("the points, the first one where the path begins", reference("point"));
  points["minItems"] = 2;
  return named("lines that fillets join, which `in` of a group may name",
               object("", {{"through", points, true},
                           {"fillet", reference("quantity", "the radius of all corners")},
                           {"closed",
                            Json{{"type", "boolean"},
                                 {"description", "whether it goes on from the last point to the first one"}}},
                           {"parent", word("a frame; default `world`")}}));
}

Json signals() {
  return named(
      "values that are measured outside of zwang",
      object("", {{"type", one_of_words("", {"bool", "number", "pose", "wrench"}), true},
                  {"unit", word("of a number")},
                  {"in", word("the frame that a pose or a wrench is seen from")},
                  {"stale_after", reference("value", "a sample that is older counts as unknown"), true},
                  {"twist", any_of({one_of_words("the sample's own", {"measured"}),
                                    reference("quantity",
                                              "of a pose: it goes on along the line through the "
                                              "samples of this time")})},
                  {"holds", word("of a bool: the frame of the base that a latch holds while it is true")}}));
}

Json features() {
  std::vector<Property> direction = {{"move", word("the frame that moves"), true},
                                     {"in", word("the frame whose axes count"), true}};
  for (const char* name : {"x", "y", "z", "rx", "ry", "rz"}) {
    direction.push_back({name, reference("quantity", "its coefficient")});
  }
  return named(
      "coordinates that are not one axis of a frame",
      object("", {{"distance", tuple("between two frames", word("a frame"), 2, 2)},
                  {"angle", tuple("between two axes, as `hook.x`", word("frame.axis"), 2, 2)},
                  {"bearing", tuple("of the second frame from the first one's x axis, in its x-y plane",
                                    word("a frame"), 2, 2)},
                  {"direction", object("a sum of axes", std::move(direction))}}));
}

Json templates() {
  const Json kinds = one_of_words("", {"frame", "task", "feature", "signal", "region", "bool", "number",
                                       "length", "angle", "time", "mass", "velocity", "acceleration", "force",
                                       "torque", "angular_velocity", "angular_acceleration"});
  const Json arguments = named("the arguments that a use must give, and their kinds", kinds);
  return named("tasks and groups with arguments",
               any_of({object("a task", {{"args", arguments}, {"body", reference("task"), true}}),
                       object("a group", {{"args", arguments}, {"group", reference("group"), true}})}));
}

}  // namespace

Json task_file() {
  Json schema = object(
      "A task of zwang",
      {version("zwang", newest_task_version),
       {"robot", word("the path of the robot file, from this file"), true},
       {"scene", word("the path of the scene file, for the simulated robot")},
       {"about", word("a sentence for reports")},
       {"params", parameters()},
       {"frames", frames()},
       {"regions", regions()},
       {"paths", paths()},
       {"signals", signals()},
       {"outputs", outputs()},
       {"features", features()},
       {"templates", templates()},
       {"always", object("constraints and exits that hold in every task",
                         {{"constraints", named("groups by their names, at level 0", reference("group"))},
                          {"exits", list("evaluated before those of the task", reference("exit"))}})},
       {"start", word("the first task"), true},
       {"tasks", named("tasks by their names", reference("task")), true}});
  schema["definitions"] = {
      {"condition",
       Json{{"type", "string"}, {"description", "comparisons with units, joined by and, or, not"}}},
      {"set", set()},
      {"axis", axis()},
      {"group", group()},
      {"exit", exit()},
      {"task", any_of({object("what the robot does until an exit leads on", task_keys()), task_use()})}};
  // A condition may be a lone signal; `when: true` is none.
  return schema;
}

}  // namespace zwang::lang::schema
