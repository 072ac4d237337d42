#include "run/sensed_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace zwang::runtime {

namespace {

constexpr double not_sensed = std::numeric_limits<double>::quiet_NaN();
constexpr double not_finite = std::numeric_limits<double>::infinity();

constexpr std::initializer_list<const char*> pose_parts = {".xx", ".yx", ".zx", ".xy", ".yy", ".zy",
                                                           ".xz", ".yz", ".zz", ".x",  ".y",  ".z"};
constexpr std::initializer_list<const char*> vector_parts = {".rx", ".ry", ".rz", ".x", ".y", ".z"};

/// Puts numbers into columns, one after the other.
struct Writer {
  void number(double x) noexcept {
    double value = x;
    if (x == 0.0 && !std::signbit(x)) value = not_sensed;
    if (!std::isfinite(x)) value = not_finite;
    values[at++] = value;
  }
  void flag(bool x) noexcept { number(x ? 1.0 : 0.0); }
  template <typename T, typename Visit>
  void maybe(const std::optional<T>& x, std::size_t columns, const Visit& visit) noexcept {
    flag(x.has_value());
    if (x) return visit(*x);
    for (std::size_t i = 0; i < columns; ++i) values[at++] = not_sensed;
  }
  std::span<double> values;
  std::size_t at = 0;
};

/// Takes them out again.
struct Reader {
  void number(double& x) noexcept {
    const double value = values[at++];
    x = std::isnan(value) ? 0.0 : std::isinf(value) ? std::numeric_limits<double>::quiet_NaN() : value;
  }
  void flag(bool& x) noexcept {
    double value = 0.0;
    number(value);
    x = value != 0.0;
  }
  template <typename T, typename Visit>
  void maybe(std::optional<T>& x, std::size_t columns, const Visit& visit) noexcept {
    bool has = false;
    flag(has);
    x.reset();
    if (has) return visit(x.emplace());
    at += columns;
  }
  std::span<const double> values;
  std::size_t at = 0;
};

template <typename Visitor, typename Values>
void visit_all(Visitor& v, Values& values) noexcept {
  for (Eigen::Index i = 0; i < values.size(); ++i) v.number(values(i));
}

template <typename Visitor, typename Pose>
void visit_pose(Visitor& v, Pose& pose) noexcept {
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) v.number(pose.rotation(row, column));
  }
  visit_all(v, pose.position);
}

template <typename Visitor, typename Vector>
void visit_vector(Visitor& v, Vector& vector) noexcept {
  visit_all(v, vector.angular);
  visit_all(v, vector.linear);
}

template <typename Visitor, typename Sample>
void visit_sample(Visitor& v, Sample& sample, lang::SignalType type) noexcept {
  v.flag(sample.valid);
  v.number(sample.stamp);
  switch (type) {
    case lang::SignalType::boolean:
      return v.flag(sample.boolean);
    case lang::SignalType::number:
      return v.number(sample.number);
    case lang::SignalType::pose:
      visit_pose(v, sample.pose);
      return v.maybe(sample.twist, vector_parts.size(), [&v](auto& twist) { visit_vector(v, twist); });
    case lang::SignalType::wrench:
      return visit_vector(v, sample.wrench);
  }
}

/// One entry a joint; none where nothing was measured.
void visit_effort(Writer& v, const Sensed& s) noexcept {
  const bool has = s.effort.size() == s.state.q.size();
  v.flag(has);
  for (Eigen::Index j = 0; j < s.state.q.size(); ++j) v.number(has ? s.effort(j) : 0.0);
}

void visit_effort(Reader& v, Sensed& s) noexcept {
  bool has = false;
  v.flag(has);
  s.effort.resize(has ? s.state.q.size() : 0);
  for (Eigen::Index j = 0; j < s.state.q.size(); ++j) {
    double value = 0.0;
    v.number(value);
    if (has) s.effort(j) = value;
  }
}

/// The same order for both ways; `SensedColumns` names it.
template <typename Visitor, typename Snapshot>
void visit_snapshot(Visitor& v, Snapshot& s, const std::vector<lang::SignalType>& types,
                    const std::vector<std::size_t>& places, bool has_stamped_samples,
                    lang::Feels::By feels) noexcept {
  v.number(s.time);
  visit_all(v, s.state.q);
  visit_all(v, s.state.qd);
  visit_all(v, s.state.tau_ff);
  visit_pose(v, s.state.base_pose);
  visit_vector(v, s.state.base_twist);
  for (auto& wrench : s.state.f_ext) visit_vector(v, wrench);
  v.flag(s.base_measured);
  v.maybe(s.base_fix, 1 + pose_parts.size(), [&v](auto& fix) {
    v.number(fix.stamp);
    visit_pose(v, fix.pose);
  });
  if (has_stamped_samples) v.maybe(s.measured_at, 1, [&v](auto& stamp) { v.number(stamp); });
  if (feels == lang::Feels::By::wrench)
    v.maybe(s.contact_wrench, vector_parts.size(), [&v](auto& wrench) { visit_vector(v, wrench); });
  if (feels == lang::Feels::By::effort) visit_effort(v, s);
  for (std::size_t i = 0; i < types.size(); ++i) {
    SignalSample missing;
    if (places[i] < s.signals.size()) {
      visit_sample(v, s.signals[places[i]], types[i]);
    } else {
      visit_sample(v, missing, types[i]);
    }
  }
}

}  // namespace

SensedColumns::SensedColumns(const solver::Model& model, const std::vector<lang::Signal>& signals,
                             const std::vector<lang::Parameter>& parameters, const lang::Drive& drive)
    : has_stamped_samples_(drive.takes_velocity), feels_(drive.feels.by) {
  name("sensed.time", {""});
  for (const char* what : {".q", ".qd", ".tau_ff"}) {
    for (int j = 0; j < model.joint_count(); ++j) name("sensed." + model.joint(j).name, {what});
  }
  name("sensed.base", pose_parts);
  name("sensed.base.twist", vector_parts);
  for (const solver::Body& body : model.bodies()) name("sensed." + body.name + ".f_ext", vector_parts);
  name("sensed.base.measured", {""});
  name("sensed.fix", {"", ".stamp"});
  name("sensed.fix", pose_parts);
  if (has_stamped_samples_) name("sensed.measured", {"", ".stamp"});
  if (feels_ == lang::Feels::By::wrench) {
    name("sensed.contact_wrench", {""});
    name("sensed.contact_wrench", vector_parts);
  }
  if (feels_ == lang::Feels::By::effort) {
    name("sensed.effort", {""});
    for (int j = 0; j < model.joint_count(); ++j) name("sensed." + model.joint(j).name, {".effort"});
  }
  for (const lang::Signal& signal : signals) {
    const std::string of = "sensed.signal." + signal.name;
    places_.push_back(types_.size());
    types_.push_back(signal.type);
    name(of, {".valid", ".stamp"});
    if (signal.type == lang::SignalType::pose) {
      name(of, pose_parts);
      name(of + ".twist", {""});
      name(of + ".twist", vector_parts);
    } else if (signal.type == lang::SignalType::wrench) {
      name(of, vector_parts);
    } else {
      name(of, {""});
    }
  }
  first_parameter_ = columns_.size();
  for (const lang::Parameter& parameter : parameters) {
    name("params." + parameter.name, {""});
    columns_.back().span = parameter.span;
  }
}

void SensedColumns::signals_at(const std::vector<std::size_t>& places) noexcept {
  std::copy(places.begin(), places.end(), places_.begin());
}

void SensedColumns::name(const std::string& of, std::initializer_list<const char*> parts) {
  for (const char* part : parts) {
    Column column;
    column.name = of + part;
    column.is_input = true;
    columns_.push_back(std::move(column));
  }
}

void SensedColumns::write(const Sensed& sensed, std::span<const double> parameters,
                          std::span<double> values) const noexcept {
  const bool sized = sensed.state.q.size() == sensed.state.qd.size() &&
                     sensed.state.q.size() == sensed.state.tau_ff.size() &&
                     static_cast<std::size_t>(sensed.state.q.size()) + 1 == sensed.state.f_ext.size();
  for (double& value : values) value = not_sensed;
  std::copy(parameters.begin(), parameters.end(),
            values.begin() + static_cast<std::ptrdiff_t>(first_parameter_));
  if (!sized) return;
  Writer writer{values};
  visit_snapshot(writer, sensed, types_, places_, has_stamped_samples_, feels_);
}

void SensedColumns::read(std::span<const double> values, Sensed& sensed,
                         std::span<double> parameters) const noexcept {
  Reader reader{values};
  visit_snapshot(reader, sensed, types_, places_, has_stamped_samples_, feels_);
  std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(first_parameter_), parameters.size(),
              parameters.begin());
}

}  // namespace zwang::runtime
