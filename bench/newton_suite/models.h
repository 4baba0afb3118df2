// Fits, bundle adjustment, pose graphs and optimal control.
#pragma once

#include "suite.h"

namespace majorant::newton_suite {

// Fits a exp(b t) + c to 30 samples, which are consistent if noise is 0.
SuiteInstance exponential_fit(double noise);
// Fits a exp(-b t) + c exp(-d t).
SuiteInstance two_exponentials(double noise);
// Fits a circle to points by their distances. arc: the angle covered by points, radians.
SuiteInstance circle_fit(double noise, double arc);
// Fits two peaks and a constant.
SuiteInstance peaks_fit();
// Fits a line with Cauchy's loss to points of which a quarter are outliers.
SuiteInstance robust_line();
// Fits a growth curve, a / (1 + exp(b - c t)).
SuiteInstance logistic_fit();
// Classifies points by the negative log-likelihood with a small penalty. Convex.
SuiteInstance logistic_regression();

// Bundle adjustment with 6 unknowns per camera and 3 per point. Nothing fixes the frame and the
// scale. noise: in pixels of 1/1000.
SuiteInstance bundle_adjustment(double noise, bool is_robust);
// A closed planar walk with odometry, loop closures and a fixed first pose.
SuiteInstance pose_graph();

// The swing-up of a pendulum in a fixed time. Unknowns: angles. Energy: the squared torque.
SuiteInstance pendulum(int n, double time);
// Van der Pol's oscillator, brought to rest. Unknowns: states and torques. Dynamics by a penalty.
SuiteInstance van_der_pol(int n);
// The path of least acceleration past round obstacles.
SuiteInstance path_past_obstacles(int n);
// The curve of quickest descent.
SuiteInstance brachistochrone(int n);
// The motion of a rigid arm of two links with least energy.
SuiteInstance two_link_arm(int n);

}  // namespace majorant::newton_suite

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
