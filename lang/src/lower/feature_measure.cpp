#include "zwang/lang/feature_measure.hpp"

namespace zwang::lang {

void set_measure(solver::AxisConstraint& c, const Feature& feature) {
  switch (feature.kind) {
    case FeatureKind::distance:
      c.measure = solver::Measure::distance;
      return;
    case FeatureKind::angle:
      c.measure = solver::Measure::angle;
      c.axis = feature.first_axis;
      c.other_axis = feature.second_axis;
      return;
    case FeatureKind::bearing:
      c.measure = solver::Measure::bearing;
      return;
    case FeatureKind::direction:
      c.measure = solver::Measure::direction;
      c.coefficients = feature.direction;
      return;
  }
}

}  // namespace zwang::lang
