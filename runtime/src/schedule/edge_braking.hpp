/// The largest deceleration of a base before the edges of a region, of which two may bind at once.
///
/// The base accelerates within a box of its own axes, |a_x| <= b_x and |a_y| <= b_y. It has only one
/// acceleration a at a time. So before two edges with the inward normals n1, n2 the same a has to give
/// n1.a >= a_1 and n2.a >= a_2.
#pragma once

#include <Eigen/Core>

namespace zwang::runtime {

/// The deceleration along the unit vector `n`, straight along it: the largest s with s n in the box.
/// `n`: in the base's axes. `box`: b_x, b_y [m/s^2].
double braking_alone(const Eigen::Vector2d& n, const Eigen::Vector2d& box) noexcept;

/// The share of both decelerations that is left where both are needed. It is the largest t <= 1 such that
/// some a in the box has n1.a >= t s1 and n2.a >= t s2, with s_i = braking_alone(n_i).
double share_of_two(const Eigen::Vector2d& n1, const Eigen::Vector2d& n2,
                    const Eigen::Vector2d& box) noexcept;

}  // namespace zwang::runtime
