#include "constraint/measure.hpp"

#include <cmath>
#include <numbers>

namespace zwang::solver {

namespace {

constexpr double degenerate = 1e-9;      // a distance, or the sine of an angle, that has no direction
constexpr double nearest_centre = 1e-3;  // of an arc, in radii

/// The angle of R = T' F about its own axis `k` alone (the twist of a swing-twist decomposition).
double twist_angle(const Matrix3& T, const Matrix3& F, int k) {
  const int i = (k + 1) % 3;
  const int j = (k + 2) % 3;
  const auto R = [&](int row, int column) { return T.col(row).dot(F.col(column)); };
  return std::atan2(R(j, i) - R(i, j), R(i, i) + R(j, j));
}

/// The coordinate of F (motion `f`) along one axis of T (motion `t`), and its velocity products:
///   translation  s = e.(p_F - p_T)   a = (p_F x e, e)    rotation  s = angle about e   a = (e, 0)
///   ds = a.(V_k - V_c)               dds = a.(A_k - A_c) + gamma,   gamma = da/dt . (V_k - V_c)
/// where e turns with T. With the origin of the coordinates at p_F and T on body c,
///   translation  gamma = (v_F x e).(w_k - w_c) + (w_c x e).(v_F - v_c(p_F))
///   rotation     gamma = (w_c x e).w_k
Measurement along_axis(const FrameMotion& f, const FrameMotion& t, Axis axis) {
  const int k = direction_of(axis);
  const Vector3 e = t.pose.rotation.col(k);
  Measurement result;
  Coordinate& now = result.now;
  (is_rotation(axis) ? result.moment : result.force) = e;
  if (is_rotation(axis)) {
    now.position = twist_angle(t.pose.rotation, f.pose.rotation, k);
    now.velocity = e.dot(f.angular - t.angular);
    now.acceleration_bias = t.angular.cross(e).dot(f.angular);
    return result;
  }
  const Vector3 offset = f.pose.position - t.pose.position;
  const Vector3 v_c = t.linear + t.angular.cross(offset);
  now.position = e.dot(offset);
  now.velocity = e.dot(f.linear - v_c);
  now.acceleration_bias =
      f.linear.cross(e).dot(f.angular - t.angular) + t.angular.cross(e).dot(f.linear - v_c);
  return result;
}

/// Everything about a direction is linear in the axes.
Measurement along_direction(const FrameMotion& f, const FrameMotion& t,
                            const std::array<double, 6>& coefficients) {
  Measurement result;
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    const double weight = coefficients[i];
    if (weight == 0.0) continue;
    const Measurement part = along_axis(f, t, static_cast<Axis>(i));
    result.now.position += weight * part.now.position;
    result.now.velocity += weight * part.now.velocity;
    result.now.acceleration_bias += weight * part.now.acceleration_bias;
    result.moment += weight * part.moment;
    result.force += weight * part.force;
  }
  return result;
}

/// s = |p_F - p_T| with e the unit vector from T to F. A point accelerates with A + w x v, so
///   ds = e.(v_F - v_T)   gamma = e.(w_k x v_F - w_c x v_T) + |v_across|^2 / s
/// The force along e acts on both bodies on the line that joins the points.
Measurement along_distance(const FrameMotion& f, const FrameMotion& t) {
  const Vector3 offset = f.pose.position - t.pose.position;
  const double s = offset.norm();
  const bool has_direction = s > degenerate;
  const Vector3 e = has_direction ? Vector3(offset / s) : Vector3(t.pose.rotation.col(0));
  const Vector3 relative = f.linear - t.linear;
  Measurement result;
  result.force = e;
  result.now.position = s;
  result.now.velocity = e.dot(relative);
  result.now.acceleration_bias = e.dot(f.angular.cross(f.linear) - t.angular.cross(t.linear));
  if (has_direction) {
    result.now.acceleration_bias += (relative - result.now.velocity * e).squaredNorm() / s;
  }
  return result;
}

/// s between the axes u of F and w of T: n sin(s) = w x u, about which the angle grows.
///   ds = n.(w_k - w_c)   gamma = dn/dt.(w_k - w_c),   dn/dt = (1 - n n') d(w x u)/dt / sin(s)
/// Axes that are parallel have no n of their own: any one across them, without gamma.
Measurement along_angle(const FrameMotion& f, const FrameMotion& t, Axis axis, Axis other_axis) {
  const Vector3 u = f.pose.rotation.col(direction_of(axis));
  const Vector3 w = t.pose.rotation.col(direction_of(other_axis));
  const Vector3 product = w.cross(u);
  const double sine = product.norm();
  const bool has_direction = sine > degenerate;
  const Vector3 n = has_direction ? Vector3(product / sine) : w.unitOrthogonal();
  const Vector3 relative = f.angular - t.angular;
  Measurement result;
  result.moment = n;
  result.now.position = std::atan2(sine, w.dot(u));
  result.now.velocity = n.dot(relative);
  if (has_direction) {
    const Vector3 rate = t.angular.cross(w).cross(u) + w.cross(f.angular.cross(u));
    result.now.acceleration_bias = (rate - n.dot(rate) * n).dot(relative) / sine;
  }
  return result;
}

/// s = atan2(y, x) of p_T in F, with d = p_T - p_F, r^2 = x^2 + y^2, and t the unit vector across d over r:
///   t = (x e_y - y e_x)/r^2     ds = t.(v_T - v_F - w_F x d)
/// s grows with the motion of T and shrinks with that of F, so a = (-d x t, -t). With the velocity
/// u = v_T - v_F - w_F x d of T seen from F, points accelerate with A + w x v, and
///   gamma = t.(w_T x v_T - w_F x v_F - w_F x (w_F x d) - 2 w_F x u) - 2 ds (x u_x + y u_y)/r^2
/// On F's z axis it has no direction.
Measurement along_bearing(const FrameMotion& f, const FrameMotion& t) {
  const Vector3 d = t.pose.position - f.pose.position;
  const Vector3 e_x = f.pose.rotation.col(0), e_y = f.pose.rotation.col(1);
  const double x = e_x.dot(d), y = e_y.dot(d);
  const double square = x * x + y * y;
  Measurement result;
  result.now.position = std::atan2(y, x);
  result.is_degenerate = square < nearest_bearing * nearest_bearing;
  if (result.is_degenerate) return result;
  const Vector3 across = (x * e_y - y * e_x) / square;
  const Vector3 seen = t.linear - f.linear - f.angular.cross(d);
  result.force = -across;
  result.moment = -d.cross(across);
  result.now.velocity = across.dot(seen);
  result.now.acceleration_bias =
      across.dot(t.angular.cross(t.linear) - f.angular.cross(f.linear) - f.angular.cross(f.angular.cross(d)) -
                 2.0 * f.angular.cross(seen)) -
      2.0 * result.now.velocity * (x * e_x.dot(seen) + y * e_y.dot(seen)) / square;
  return result;
}

/// The measures along the arc through T's origin along T's x, with the centre (0, 1/k). At (x, y) in T the
/// nearest point of the arc has the tangent t = (cos f, sin f) and the normal n = (-sin f, cos f):
///   q sin f = k x,   q cos f = 1 - k y,   q = 1 - k o     o: the offset along n
///   s = s_0 + f/k    u = t.v    do = n.v    df = k u/q
/// The row of x has u for its velocity, not ds = u/q. Its multiplier is then the force along t, and a range
/// of that force is in newtons wherever the frame is. With the accelerations of x and y as along an axis of T
///   du = t.a + df do       ddo = n.a - df u
/// The heading r = rz - f turns against the tangent with dr = drz - df. An acceleration along the path adds
/// nothing to the heading's row: ddr = ddrz where df is constant, and the row presses with a torque alone.
Measurement along_path(const FrameMotion& f, const FrameMotion& t, const AxisConstraint& c) {
  if (c.axis == Axis::z) return along_axis(f, t, Axis::z);
  const double k = c.curvature;
  const Measurement x = along_axis(f, t, Axis::x), y = along_axis(f, t, Axis::y);
  const double ahead = k * x.now.position, inwards = 1.0 - k * y.now.position;
  const double q = std::hypot(ahead, inwards);
  Measurement result;
  result.is_degenerate = q < nearest_centre;
  if (result.is_degenerate) return result;
  const double sine = ahead / q, cosine = inwards / q, angle = std::atan2(ahead, inwards);
  const double along = cosine * x.now.velocity + sine * y.now.velocity;
  const double across = cosine * y.now.velocity - sine * x.now.velocity;
  const double turning = k * along / q;
  Coordinate& now = result.now;
  if (is_rotation(c.axis)) {
    result = along_axis(f, t, Axis::rz);
    now.position = std::remainder(now.position - angle, 2.0 * std::numbers::pi);
    now.velocity -= turning;
  } else if (c.axis == Axis::x) {
    result.force = cosine * x.force + sine * y.force;
    now.position = c.arc_length + (k == 0.0 ? x.now.position : angle / k);
    now.velocity = along;
    now.acceleration_bias =
        cosine * x.now.acceleration_bias + sine * y.now.acceleration_bias + turning * across;
  } else {
    result.force = cosine * y.force - sine * x.force;
    now.position = k == 0.0 ? y.now.position : (1.0 - q) / k;
    now.velocity = across;
    now.acceleration_bias =
        cosine * y.now.acceleration_bias - sine * x.now.acceleration_bias - turning * along;
  }
  return result;
}

/// ds = |v| in T's plane, and d|v|/dt = v.dv/dt / |v|: the direction of the present motion.
Measurement along_motion(const FrameMotion& f, const FrameMotion& t) {
  const double vx = along_axis(f, t, Axis::x).now.velocity;
  const double vy = along_axis(f, t, Axis::y).now.velocity;
  const double speed = std::hypot(vx, vy);
  if (!(speed > 0.0)) return {};
  Measurement result = along_direction(f, t, {vx / speed, vy / speed, 0.0, 0.0, 0.0, 0.0});
  result.now.position = 0.0;
  return result;
}

/// Along an axis e that the body carries, at the origin p of F:
///   translation  a = (p x e, e)    rotation  a = (e, 0)
ForceVector carried_axis(const AttachedFrame& move, const AttachedFrame& in, Axis axis) {
  const Vector3 e = in.pose.rotation.col(direction_of(axis));
  if (is_rotation(axis)) return {e, Vector3::Zero()};
  return {move.pose.position.cross(e), e};
}

ForceVector carried_direction(const AxisConstraint& c) {
  ForceVector a;
  for (std::size_t i = 0; i < c.coefficients.size(); ++i) {
    const double weight = c.coefficients[i];
    if (weight != 0.0) a += carried_axis(c.move, c.in, static_cast<Axis>(i)) * weight;
  }
  return a;
}

/// As `along_motion`.
ForceVector carried_motion(const AxisConstraint& c, const MotionVector& V) {
  const ForceVector x = carried_axis(c.move, c.in, Axis::x);
  const ForceVector y = carried_axis(c.move, c.in, Axis::y);
  const double vx = dot(x, V);
  const double vy = dot(y, V);
  const double speed = std::hypot(vx, vy);
  if (!(speed > 0.0)) return {};
  return x * (vx / speed) + y * (vy / speed);
}

/// s = w v:  ds = w dv + v dw.
ForceVector carried_turn(const AxisConstraint& c, const MotionVector& V) {
  const ForceVector along = carried_direction(c);
  const ForceVector about = carried_axis(c.move, c.in, Axis::rz);
  return along * dot(about, V) + about * dot(along, V);
}

}  // namespace

ForceVector carried_force(const AxisConstraint& c, const MotionVector& V) noexcept {
  if (c.measure == Measure::direction || c.measure == Measure::side) return carried_direction(c);
  if (c.measure == Measure::turn) return carried_turn(c, V);
  if (c.measure == Measure::speed) return carried_motion(c, V);
  return carried_axis(c.move, c.in, c.axis);
}

double carried_bias(const AxisConstraint& c, const ForceVector& a, const MotionVector& V) noexcept {
  if (c.measure != Measure::side) return 0.0;
  return a.linear.dot(V.angular.cross(V.linear + V.angular.cross(c.move.pose.position)));
}

double measure_position(Axis axis, const Pose& f, const Pose& t) noexcept {
  const int k = direction_of(axis);
  return is_rotation(axis) ? twist_angle(t.rotation, f.rotation, k)
                           : t.rotation.col(k).dot(f.position - t.position);
}

Measurement measure(const AxisConstraint& constraint, const FrameMotion& f, const FrameMotion& t) noexcept {
  switch (constraint.measure) {
    case Measure::axis:
      return along_axis(f, t, constraint.axis);
    case Measure::direction:
    case Measure::side:
      return along_direction(f, t, constraint.coefficients);
    case Measure::distance:
      return along_distance(f, t);
    case Measure::angle:
      return along_angle(f, t, constraint.axis, constraint.other_axis);
    case Measure::bearing:
      return along_bearing(f, t);
    case Measure::path:
      return along_path(f, t, constraint);
    case Measure::speed:
      return along_motion(f, t);
    case Measure::turn:  // of carried axes alone
      break;
  }
  return {};
}

}  // namespace zwang::solver
