/// Names of wheels, and of what is beside them, in English, German, French, Spanish and Italian.
#pragma once

#include <string>

namespace zwang::lang {

bool is_called_wheel(const std::string& name);
/// Of a wheel that follows: `caster`, `Lenkrolle`, `roue folle`, `rueda loca`, `ruota pivottante`.
bool is_called_caster(const std::string& name);
/// Of a ball that rolls every way.
bool is_called_ball(const std::string& name);
/// Of a joint that steers a wheel.
bool is_called_steering(const std::string& name);
/// Of a joint above a car's wheel that steers it. A suspension may have such a name, too.
bool is_called_hinge(const std::string& name);
/// Of a sensor that may turn to look around.
bool is_called_sensor(const std::string& name);

}  // namespace zwang::lang
