// Fits, bundle adjustment, pose graphs and optimal control.
#pragma once

#include "suite.h"

namespace majorant::newton_suite {

// a exp(b t) + c through 30 samples; noise 0: consistent.
SuiteInstance exponential_fit(double noise);
// a exp(-b t) + c exp(-d t).
SuiteInstance two_exponentials(double noise);
// A circle through points, by distances; arc: the part of it that has points, in radians.
SuiteInstance circle_fit(double noise, double arc);
// Two peaks and a constant.
SuiteInstance peaks_fit();
// A line through points of which a quarter are outliers: the loss of Cauchy.
SuiteInstance robust_line();
// A curve of growth, a / (1 + exp(b - c t)).
SuiteInstance logistic_fit();
// Classes of points: the negative log-likelihood with a small penalty. Convex.
SuiteInstance logistic_regression();

// Cameras of 6 and points of 3; nothing holds the frame and the scale. noise: in pixels of 1/1000.
SuiteInstance bundle_adjustment(double noise, bool is_robust);
// A planar walk that closes: odometry and loops, the first pose held.
SuiteInstance pose_graph();

// Angles of a pendulum that swings up in a fixed time; energy: the torque squared.
SuiteInstance pendulum(int n, double time);
// Van der Pol's oscillator to rest: states and torques, dynamics by a penalty.
SuiteInstance van_der_pol(int n);
// The path past round obstacles with least acceleration.
SuiteInstance path_past_obstacles(int n);
// The curve of quickest descent.
SuiteInstance brachistochrone(int n);
// Minimum-energy transfer of a rigid arm of two links.
SuiteInstance two_link_arm(int n);

}  // namespace majorant::newton_suite

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
