/// Faults of samples and of motors, injected between the runtime and a plant. Knows no simulator.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "zwang/lang/scene.hpp"
#include "zwang/runtime/plant.hpp"

namespace zwang::runtime {

class InjectedFaults {
 public:
  /// `of_scene` and then those `of_run`, which a scenario adds. Throws std::invalid_argument on a fault of a
  /// joint that the model does not have.
  InjectedFaults(const std::vector<lang::Fault>& of_scene, const std::vector<lang::Fault>& of_run,
                 const solver::Model& model);

  /// Whether a fault counts from a time of the run that has not come.
  bool waits() const noexcept;
  /// This time of the run has come: `run.entered.press`.
  void come(const std::string& of, double time) noexcept;
  /// [s] when the first fault of the run begins; infinite while nobody knows.
  double onset_of_run() const noexcept;
  /// Without those that were put on by hand. `at` of one that waits is infinite.
  std::vector<lang::Fault> all() const;

  /// By hand: from its `at` until `lift`, before all others of its kind. `joint`: -1 of none.
  void put(const lang::Fault& fault, Eigen::Index joint);
  /// Ends the faults of this kind and joint that were put on by hand.
  void lift(lang::FaultKind kind, Eigen::Index joint);

  bool active(lang::FaultKind kind, double time) const noexcept;
  /// The first fault of the kind in force, or none; of those that name a joint, this one's.
  const lang::Fault* find(lang::FaultKind kind, double time, Eigen::Index joint = -1) const noexcept;
  /// Whether the object leaves, once: in the step in which its fault begins.
  bool object_leaves(const std::string& object, double time) noexcept;
  /// Turns a true sample into the one that arrives; allocates nothing.
  void spoil(Sensed& sensed) noexcept;
  /// Turns the command into the motors' torques.
  void spoil(Eigen::VectorXd& tau, double time) noexcept;

 private:
  struct Injected {
    lang::Fault fault;
    Eigen::Index joint = -1;
    bool by_hand = false;
    bool of_run = false;
    double after = 0.0;  ///< [s] after the time from which it counts
    bool has_begun = false;
    double kept = 0.0;  ///< torque at the onset
  };
  static bool in_force(const lang::Fault& fault, double time) noexcept;

  std::vector<Injected> faults_;
  solver::State kept_;  ///< at the onset of a frozen state
  bool is_frozen_ = false;
};

}  // namespace zwang::runtime
