/// A program as text without its places: two files that mean the same give the same text.
#pragma once

#include <sstream>

#include "zwang/lang/program.hpp"

namespace zwang::lang::test {

class ProgramText {
 public:
  explicit ProgramText(const Program& program) {
    out_.precision(17);
    out_ << program.about << '|' << program.robot.name << '|' << program.start << '\n';
    for (const Parameter& p : program.parameters) {
      out_ << "param " << p.name << ' ' << p.value << ' ' << p.unit << ' ' << p.help;
      if (p.range) out_ << " [" << p.range->low << ' ' << p.range->high << ']';
      out_ << '\n';
    }
    for (const FrameDeclaration& f : program.frames) {
      out_ << "frame " << f.name << ' ' << static_cast<int>(f.parent) << ' ' << f.parent_index << ' '
           << f.pose.position.transpose() << ' ' << f.pose.rotation.row(0) << ' ' << f.pose.rotation.row(1)
           << '\n';
    }
    for (const Signal& s : program.signals) {
      out_ << "signal " << s.name << ' ' << static_cast<int>(s.type) << ' ' << s.unit_scale << ' ' << s.in
           << ' ';
      add(s.stale_after);
      out_ << static_cast<int>(s.twist) << ' ' << s.twist_window << '\n';
    }
    for (const Output& o : program.outputs)
      out_ << "output " << o.name << ' ' << o.is_number << ' ' << o.start << ' ' << o.stop.value_or(-1.0)
           << o.stop.has_value() << '\n';
    for (const Region& r : program.regions) {
      out_ << "region " << r.name << ' ' << r.parent << ' ' << r.centre[0] << ' ' << r.centre[1] << ' '
           << r.radius;
      for (const auto& corner : r.polygon) out_ << " (" << corner[0] << ' ' << corner[1] << ')';
      out_ << '\n';
    }
    for (const Feature& f : program.features) {
      out_ << "feature " << f.name << ' ' << static_cast<int>(f.kind) << ' ' << f.first << ' ' << f.second
           << ' ' << static_cast<int>(f.first_axis) << ' ' << static_cast<int>(f.second_axis);
      for (const double c : f.direction) out_ << ' ' << c;
      out_ << '\n';
    }
    add(program.always.groups);
    add(program.always.exits);
    for (const Task& t : program.tasks) add(t);
  }

  std::string text() const { return out_.str(); }

 private:
  void add(const Value& v) {
    out_ << v.constant << '/' << v.parameter << '/' << v.sign << '/' << v.signal << ' ';
  }
  void add(const std::optional<Value>& v) {
    if (v) add(*v);
    out_ << ';';
  }
  void add(const std::optional<ValueRange>& r) {
    if (r) add(r->low), add(r->high);
    out_ << ';';
  }
  void add(const Target& t) { out_ << "-> " << static_cast<int>(t.kind) << ' ' << t.task << ' '; }
  void add(const Condition& c) {
    for (const ExpressionNode& n : c.nodes) {
      out_ << '(' << static_cast<int>(n.op) << ' ' << n.number << ' ' << n.index << ' ' << n.axis << ' '
           << n.function << ' ' << n.in_always << ' ' << static_cast<int>(n.what) << ' ' << n.left << ' '
           << n.right << ')';
    }
  }
  void add(const std::vector<SetAction>& sets) {
    for (const SetAction& s : sets) {
      out_ << "set " << static_cast<int>(s.kind) << ' ' << s.index << ' ' << s.source << ' ';
      add(s.value);
    }
  }
  void add(const std::vector<Group>& groups) {
    for (const Group& g : groups) {
      out_ << "group " << g.name << ' ' << g.move << ' ' << g.in << ' ' << static_cast<int>(g.kind) << ' '
           << g.region << ' ' << g.moves_footprint << ' ' << g.level << ' ' << g.feature << ' ';
      add(g.margin);
      for (const AxisStatements& a : g.axes) {
        out_ << "\n  " << a.name << ' ' << (a.driver ? static_cast<int>(*a.driver) : -1) << ' ' << a.here
             << ' ' << a.level << ' ' << a.is_planar << ' ';
        add(a.target);
        add(a.position), add(a.velocity), add(a.acceleration), add(a.force);
        add(a.time_constant);
        add(a.stiffness), add(a.damping), add(a.weight), add(a.build_up);
        if (a.yield) add(a.yield->force), add(a.yield->mass), add(a.yield->damping), add(a.yield->dead_band);
      }
      out_ << '\n';
    }
  }
  void add(const std::vector<Exit>& exits) {
    for (const Exit& e : exits) {
      out_ << "exit ";
      add(e.when);
      add(e.dwell);
      add(e.release);
      add(e.target);
      add(e.set);
      out_ << e.note << '\n';
    }
  }
  void add(const Task& t) {
    out_ << "task " << t.name << ' ' << t.about << ' ';
    if (t.require) add(*t.require);
    if (t.attempts) out_ << t.attempts->most << ' ', add(t.attempts->target);
    add(t.blend);
    add(t.set_on_entry);
    if (t.timeout) add(t.timeout->after), add(t.timeout->target);
    out_ << '\n';
    add(t.groups);
    add(t.exits);
  }

  std::ostringstream out_;
};

}  // namespace zwang::lang::test
