#include "majorant/terms/robust_loss.h"

#include <ceres/loss_function.h>

#include <cmath>
#include <memory>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

template <class Loss>
RobustLoss loss_of_width(double width) {
  if (!(width > 0) || !std::isfinite(width))
    throw InvalidArgument("robust loss: the width must be positive");
  return [loss = std::make_shared<const Loss>(width)](double s) {
    std::array<double, 3> rho;
    loss->Evaluate(s, rho.data());
    return rho;
  };
}

}  // namespace

RobustLoss huber_loss(double width) { return loss_of_width<ceres::HuberLoss>(width); }
RobustLoss soft_l1_loss(double width) { return loss_of_width<ceres::SoftLOneLoss>(width); }
RobustLoss cauchy_loss(double width) { return loss_of_width<ceres::CauchyLoss>(width); }
RobustLoss arctan_loss(double width) { return loss_of_width<ceres::ArctanLoss>(width); }
RobustLoss tukey_loss(double width) { return loss_of_width<ceres::TukeyLoss>(width); }

}  // namespace majorant
