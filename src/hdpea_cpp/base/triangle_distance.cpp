// SPDX-License-Identifier: GPL-3.0-or-later
#include "hdpea_cpp/base/triangle_distance.hpp"

namespace hdpea {

double squared_distance_from_triangle(const Eigen::RowVector3d& p, const Eigen::RowVector3d& a,
                                      const Eigen::RowVector3d& b, const Eigen::RowVector3d& c) {
  const Eigen::RowVector3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double abp = ab.dot(ap), acp = ac.dot(ap);
  if (abp <= 0 && acp <= 0) return ap.squaredNorm();
  const double abp_at_b = ab.dot(bp), acp_at_b = ac.dot(bp);
  if (abp_at_b >= 0 && acp_at_b <= abp_at_b) return bp.squaredNorm();
  const double weight_c = abp * acp_at_b - abp_at_b * acp;
  if (weight_c <= 0 && abp >= 0 && abp_at_b <= 0) return (ap - abp / (abp - abp_at_b) * ab).squaredNorm();
  const double abp_at_c = ab.dot(cp), acp_at_c = ac.dot(cp);
  if (acp_at_c >= 0 && abp_at_c <= acp_at_c) return cp.squaredNorm();
  const double weight_b = abp_at_c * acp - abp * acp_at_c;
  if (weight_b <= 0 && acp >= 0 && acp_at_c <= 0) return (ap - acp / (acp - acp_at_c) * ac).squaredNorm();
  const double weight_a = abp_at_b * acp_at_c - abp_at_c * acp_at_b;
  const double to_c = acp_at_b - abp_at_b, to_b = abp_at_c - acp_at_c;
  if (weight_a <= 0 && to_c >= 0 && to_b >= 0) return (bp - to_c / (to_c + to_b) * (c - b)).squaredNorm();
  return (ap - (weight_b * ab + weight_c * ac) / (weight_a + weight_b + weight_c)).squaredNorm();
}

}  // namespace hdpea
