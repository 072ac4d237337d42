/// Every name of a task file and what it stands for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "spec/task_file.hpp"
#include "zwang/lang/program.hpp"

namespace zwang::lang {

struct ParameterSymbol {
  Parameter parameter;
  Dimension dimension;
  solver::Range values{0.0, 0.0};  ///< that it can take, by its range or by the file's `set` [SI]
  solver::Range admitted;          ///< that its places can take: bounds one without a range [SI]
  bool is_bad = false;             ///< declared, but not readable
  bool is_used = false;
};

struct FrameSymbol {
  FrameDeclaration declaration;
  int body = -1;             ///< that carries it; -1: it stands in the world
  int path = -1;             ///< that begins in it, of TaskFile::paths
  bool is_declared = false;  ///< by the task file, rather than by the robot
  bool is_bad = false;
  bool is_used = false;
};

struct SignalSymbol {
  Signal signal;
  Dimension dimension;  ///< of a number
  bool is_bad = false;
  bool is_used = false;
};

struct OutputSymbol {
  Output output;
  Dimension dimension;  ///< of a number
  bool is_bad = false;
  bool is_used = false;
};

struct FeatureSymbol {
  Feature feature;
  bool is_bad = false;
  bool is_used = false;
};

struct RegionSymbol {
  Region region;
  bool is_bad = false;
  bool is_used = false;
};

struct Symbols {
  std::vector<ParameterSymbol> parameters;
  std::vector<FrameSymbol> frames;  ///< in the order of Program::frames
  std::vector<SignalSymbol> signals;
  std::vector<OutputSymbol> outputs;
  std::vector<FeatureSymbol> features;
  std::vector<RegionSymbol> regions;
  std::vector<std::string> tasks;
  bool has_robot = true;  ///< false: its frames are unknown, so no name can be called unknown

  ParameterSymbol* find_parameter(const std::string& name);
  std::optional<int> find_frame(const std::string& name) const;
  /// Whether nothing ever carries the frame along: neither the robot nor the samples of a signal.
  bool stands_in_world(int frame) const;
  /// The pose signal that the frame hangs on, over any number of frames; -1: none.
  int signal_of(int frame) const;
  std::optional<int> find_task(const std::string& name) const;
  std::optional<int> find_signal(const std::string& name) const;
  std::optional<int> find_output(const std::string& name) const;
  std::optional<int> find_feature(const std::string& name) const;
  std::optional<int> find_region(const std::string& name) const;
  std::vector<std::string> signal_names() const;
  std::vector<std::string> output_names() const;
  std::vector<std::string> feature_names() const;
  std::vector<std::string> region_names() const;
  std::vector<std::string> parameter_names() const;
  std::vector<std::string> frame_names() const;
};

}  // namespace zwang::lang
