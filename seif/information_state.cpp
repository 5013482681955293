#include "seif/information_state.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace seif {

InformationState::InformationState(const PoseEstimate& start) {
  const Eigen::LLT<Eigen::Matrix3d> llt(start.covariance);
  if (llt.info() != Eigen::Success) {
    throw std::invalid_argument("the covariance of the start estimate is not positive definite");
  }
  reserve_window(8);
  Omega_.topLeftCorner<3, 3>() = llt.solve(Eigen::Matrix3d::Identity());
  mu_.head<3>() << start.mean.x, start.mean.y, start.mean.theta;
  linearisation_pose_ = start.mean;
}

Eigen::Vector2d InformationState::move_pose(const Pose2& pose) {
  const Pose2 before = this->pose();
  mu_.head<3>() << pose.x, pose.y, pose.theta;
  if (!uses_first_estimates()) return {pose.x - before.x, pose.y - before.y};

  first_estimates_.clear();
  for (int position = 0; position < active_count(); ++position) {
    first_estimates_.push_back(
        {mu_.segment<2>(row_of(position)), landmarks_[index(active(position))].first_estimate});
  }
  const Pose2 from = linearisation_pose_;
  const Pose2 carried = from * (inverse(before) * pose);
  const FramedPose framed = pose_among(first_estimates_, pose, carried, sighting_sd_);
  linearisation_pose_ = framed.pose;
  const Pose2 to = framed.another_frame ? carried : framed.pose;  // changing the frame is no motion
  return {to.x - from.x, to.y - from.y};
}

Eigen::Vector2d InformationState::linearisation_point(int slot) const {
  return uses_first_estimates() ? Eigen::Vector2d(landmarks_[index(slot)].first_estimate) : mean(slot);
}

Eigen::Vector2d InformationState::lever(int slot, const Eigen::Vector2d& p_world_landmark) const {
  Eigen::Vector2d lever = p_world_landmark - mu_.head<2>();
  if (!uses_first_estimates()) return lever;
  const Eigen::Vector2d first = first_lever(slot);
  return stands_for(first, lever, sighting_sd_) ? first : lever;
}

Eigen::Vector2d InformationState::first_lever(int slot) const {
  return linearisation_point(slot) - Eigen::Vector2d(linearisation_pose_.x, linearisation_pose_.y);
}

std::optional<Pose2> InformationState::other_linearisation_pose() const {
  if (!uses_first_estimates()) return std::nullopt;
  for (const int slot : active_) {
    const Eigen::Vector2d lever = mean(slot) - mu_.head<2>();
    if (stands_for(first_lever(slot), lever, sighting_sd_)) continue;
    const Eigen::Vector2d p = linearisation_point(slot) - lever;
    return Pose2{p.x(), p.y(), linearisation_pose_.theta};
  }
  return std::nullopt;
}

/// Not turned as the frame is: the small turns of many landmarks, each placed by those before it, would add
/// up.
Eigen::Vector2d InformationState::among_first_estimates(const Eigen::Vector2d& p_world) const {
  if (!uses_first_estimates()) return p_world;
  return Eigen::Vector2d(linearisation_pose_.x, linearisation_pose_.y) + p_world - mu_.head<2>();
}

/// No longer than until it has a link to a passive landmark: moving it would link the pose to that one.
void InformationState::update_first_estimates() {
  for (int position = 0; position < active_count(); ++position) {
    const Landmark& landmark = landmarks_[index(active(position))];
    if (landmark.sightings > settled_after_ || landmark.first_link != none) continue;
    move_first_estimate(position, among_first_estimates(mu_.segment<2>(row_of(position))));
  }
}

/// Omega knows nothing of turning everything about the first estimates as they were. With its variables
/// changed so that turning the pose by dtheta takes the landmark along by J (from - to) dtheta, J a quarter
/// turn, it knows nothing of turning everything about those that there are now.
void InformationState::move_first_estimate(int position, const Eigen::Vector2d& to) {
  Point& first_estimate = landmarks_[index(active(position))].first_estimate;
  const Eigen::Vector2d by = to - first_estimate;
  first_estimate = to;
  auto Omega = this->Omega();
  const int row = row_of(position);
  Omega.col(2) += by.y() * Omega.col(row) - by.x() * Omega.col(row + 1);
  Omega.row(2) += by.y() * Omega.row(row) - by.x() * Omega.row(row + 1);
  r_(2) += by.y() * r_(row) - by.x() * r_(row + 1);
  touch(active_count() + 1);
}

void InformationState::mark_seen(int slot) {
  Landmark& landmark = landmarks_[index(slot)];
  if (landmark.sightings == 0 || landmark.last_seen != scan_) ++landmark.sightings;
  landmark.last_seen = scan_;
}

Eigen::Vector2d InformationState::mean(int slot) const {
  const Landmark& landmark = landmarks_[index(slot)];
  if (landmark.position == none) return landmark.mu;
  return mu_.segment<2>(row_of(landmark.position));
}

Eigen::Vector2d InformationState::residual(int slot) const {
  const Landmark& landmark = landmarks_[index(slot)];
  if (landmark.position == none) return landmark.r;
  return r_.segment<2>(row_of(landmark.position));
}

Eigen::Matrix2d InformationState::information(int slot) const {
  const Landmark& landmark = landmarks_[index(slot)];
  if (landmark.position == none) return landmark.Omega_ii;
  const int row = row_of(landmark.position);
  return Omega_.block<2, 2>(row, row);
}

int InformationState::add_landmark(LandmarkId landmark, const Eigen::Vector2d& mean) {
  const int slot = landmark_count();
  index_.insert(landmark, slot);
  landmarks_.push_back({.id = landmark, .mu = mean, .first_estimate = among_first_estimates(mean)});
  return slot;
}

int InformationState::add_link(int slot_i, int slot_j, const Block& Omega_ij) {
  const int link = static_cast<int>(links_.size());
  Landmark& i = landmarks_[index(slot_i)];
  Landmark& j = landmarks_[index(slot_j)];
  links_.push_back({.end = {slot_i, slot_j}, .next = {i.first_link, j.first_link}, .Omega_ij = Omega_ij});
  i.first_link = link;
  j.first_link = link;
  return link;
}

void InformationState::set_link(int link, int slot_i, const Block& Omega_ij) {
  Link& l = links_[index(link)];
  if (l.end[0] == slot_i) {
    l.Omega_ij = Omega_ij;
  } else {
    l.Omega_ij = Omega_ij.transpose();
  }
}

int InformationState::activate(int slot) {
  assert(position(slot) == none);
  const int position = active_count();
  reserve_window(position + 1);
  active_.push_back(slot);
  load_into_window(slot, position);
  landmarks_[index(slot)].position = position;
  return position;
}

void InformationState::load_into_window(int slot, int position) {
  Landmark& landmark = landmarks_[index(slot)];
  squared_residual_ -= std::exchange(landmark.squared_residual, 0.0);
  const int row = row_of(position);
  Omega_.middleRows<2>(row).leftCols(row + 2).setZero();
  Omega_.middleCols<2>(row).topRows(row + 2).setZero();
  Omega_.block<2, 2>(row, row) = landmark.Omega_ii;
  mu_.segment<2>(row) = landmark.mu;
  r_.segment<2>(row) = landmark.r;
  link_of_.row(position).head(position + 1).setConstant(none);
  link_of_.col(position).head(position + 1).setConstant(none);
  for_each_link(slot, [&](int link, int end, int other) {
    const int other_position = landmarks_[index(other)].position;
    if (other_position == none) return;
    const int other_row = row_of(other_position);
    const Block& stored = links_[index(link)].Omega_ij;
    const Block Omega_so = end == 0 ? stored : Block(stored.transpose());
    Omega_.block<2, 2>(row, other_row) = Omega_so;
    Omega_.block<2, 2>(other_row, row) = Omega_so.transpose();
    link_of_(position, other_position) = link_of_(other_position, position) = link;
    touch(1);
  });
  touch(1);
}

void InformationState::deactivate(int position) {
  const int slot = active(position);
  assert(Omega_.block(0, row_of(position), 3, 2).isZero(0.0));
  store_from_window(position);
  landmarks_[index(slot)].position = none;
  const int last = active_count() - 1;
  if (position != last) move_within_window(last, position);
  active_.pop_back();
}

void InformationState::store_from_window(int position) {
  const int slot = active(position);
  const int row = row_of(position);
  Landmark& landmark = landmarks_[index(slot)];
  landmark.mu = mu_.segment<2>(row);
  landmark.r = r_.segment<2>(row);
  landmark.Omega_ii = Omega_.block<2, 2>(row, row);
  note_residual(landmark);
  for (int other = 0; other < active_count(); ++other) {
    if (other == position) continue;
    const Block Omega_so = Omega_.block<2, 2>(row, row_of(other));
    if (const int link = link_of_(position, other); link != none) {
      set_link(link, slot, Omega_so);
    } else if (!Omega_so.isZero(0.0)) {
      add_link(slot, active(other), Omega_so);
    }
  }
  touch(active_count());
}

void InformationState::move_within_window(int from, int to) {
  const int size = window_size();
  const int from_row = row_of(from);
  const int to_row = row_of(to);
  Omega_.middleRows<2>(to_row).leftCols(size) = Omega_.middleRows<2>(from_row).leftCols(size);
  Omega_.middleCols<2>(to_row).topRows(size) = Omega_.middleCols<2>(from_row).topRows(size);
  Omega_.block<2, 2>(to_row, to_row) = Omega_.block<2, 2>(from_row, from_row);
  mu_.segment<2>(to_row) = mu_.segment<2>(from_row);
  r_.segment<2>(to_row) = r_.segment<2>(from_row);
  link_of_.row(to).head(active_count()) = link_of_.row(from).head(active_count());
  link_of_.col(to).head(active_count()) = link_of_.col(from).head(active_count());
  link_of_(to, to) = none;
  active_[index(to)] = active_[index(from)];
  landmarks_[index(active(to))].position = to;
}

void InformationState::reserve_window(int active_landmarks) {
  const int room = static_cast<int>(link_of_.rows());
  if (active_landmarks <= room) return;
  const int new_room = std::max(active_landmarks, 2 * room);
  const int rows = row_of(new_room);
  Omega_.conservativeResizeLike(Eigen::MatrixXd::Zero(rows, rows));
  work_.resize(rows, rows);
  work_columns_.resize(rows, 3);
  mu_.conservativeResizeLike(Eigen::VectorXd::Zero(rows));
  r_.conservativeResizeLike(Eigen::VectorXd::Zero(rows));
  link_of_.conservativeResizeLike(Eigen::MatrixXi::Constant(new_room, new_room, none));
  active_.reserve(index(new_room));
  first_estimates_.reserve(index(new_room));
}

void InformationState::move_robot(const Eigen::Vector3d& d) {
  mu_.head<3>() += d;
  mu_(2) = wrap_angle(mu_(2));
  r().noalias() -= Omega().leftCols<3>() * d;
  touch(active_count() + 1);
}

void InformationState::move_landmark(int slot, const Eigen::Vector2d& d) {
  Landmark& landmark = landmarks_[index(slot)];
  if (landmark.position != none) {
    const int row = row_of(landmark.position);
    mu_.segment<2>(row) += d;
    r().noalias() -= Omega().middleCols<2>(row) * d;
    touch(active_count() + 1);
  } else {
    landmark.mu += d;
    landmark.r -= landmark.Omega_ii * d;
    note_residual(landmark);
    touch(1);
  }
  for_each_link(slot, [&](int link, int end, int other) {
    Landmark& neighbour = landmarks_[index(other)];
    if (landmark.position != none && neighbour.position != none) return;  // its block is the window's
    const Block& Omega_ij = links_[index(link)].Omega_ij;
    const Eigen::Vector2d dr =
        end == 0 ? Eigen::Vector2d(Omega_ij.transpose() * d) : Eigen::Vector2d(Omega_ij * d);
    if (neighbour.position == none) {
      neighbour.r -= dr;
      note_residual(neighbour);
    } else {
      r_.segment<2>(row_of(neighbour.position)) -= dr;
    }
    touch(1);
  });
}

void InformationState::move_window(const Eigen::Ref<const Eigen::VectorXd>& d) {
  mu_.head(window_size()) += d;
  mu_(2) = wrap_angle(mu_(2));
  r().noalias() -= Omega() * d;
  touch(window_blocks());
  for (int position = 0; position < active_count(); ++position) {
    const Eigen::Vector2d d_i = d.segment<2>(row_of(position));
    for_each_link(active(position), [&](int link, int end, int other) {
      Landmark& neighbour = landmarks_[index(other)];
      if (neighbour.position != none) return;  // its block is the window's
      const Block& Omega_ij = links_[index(link)].Omega_ij;
      if (end == 0) {
        neighbour.r -= Omega_ij.transpose() * d_i;
      } else {
        neighbour.r -= Omega_ij * d_i;
      }
      note_residual(neighbour);
      touch(1);
    });
  }
}

void InformationState::move_window(const Eigen::Ref<const Eigen::VectorXd>& d,
                                   const Eigen::Ref<const Eigen::VectorXd>& dr) {
  mu_.head(window_size()) += d;
  mu_(2) = wrap_angle(mu_(2));
  r() -= dr;
  touch(active_count() + 1);
}

void InformationState::set_mean(int slot, const Eigen::Vector2d& mean) {
  assert(position(slot) == none);
  landmarks_[index(slot)].mu = mean;
}

/// Of a passive landmark whose r has changed.
void InformationState::note_residual(Landmark& landmark) {
  if (!tracks_residual_) return;
  const double now = landmark.r.dot(landmark.Omega_ii.inverse() * landmark.r);
  squared_residual_ += now - std::exchange(landmark.squared_residual, now);
}

double InformationState::squared_residual() const {
  const Eigen::Vector3d r_x = r_.head<3>();
  double sum = squared_residual_ + r_x.dot(Omega_.topLeftCorner<3, 3>().llt().solve(r_x));
  for (int position = 0; position < active_count(); ++position) {
    const int row = row_of(position);
    const Eigen::Vector2d r_i = r_.segment<2>(row);
    sum += r_i.dot(Omega_.block<2, 2>(row, row).inverse() * r_i);
  }
  return sum;
}

std::int64_t InformationState::link_count() const {
  std::int64_t links = active_count() + static_cast<std::int64_t>(links_.size());
  for (int i = 0; i < active_count(); ++i) {
    for (int j = 0; j < i; ++j) {
      if (link_of_(i, j) == none && !Omega_.block<2, 2>(row_of(i), row_of(j)).isZero(0.0)) ++links;
    }
  }
  return links;
}

std::size_t InformationState::memory_bytes() const {
  return landmarks_.memory_bytes() + links_.memory_bytes() + index_.memory_bytes() +
         sizeof(double) * static_cast<std::size_t>(2 * Omega_.size() + 2 * mu_.size() + 3 * mu_.size()) +
         sizeof(int) * (static_cast<std::size_t>(link_of_.size()) + active_.capacity());
}

Eigen::SparseMatrix<double> InformationState::full_Omega() const {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add_block = [&](int row, int col, const auto& block) {
    for (int i = 0; i < block.rows(); ++i) {
      for (int j = 0; j < block.cols(); ++j) {
        if (row + i >= col + j) entries.emplace_back(row + i, col + j, block(i, j));
      }
    }
  };
  add_block(0, 0, Omega_.topLeftCorner<3, 3>());
  for (int slot = 0; slot < landmark_count(); ++slot) {
    add_block(row_of(slot), row_of(slot), information(slot));
  }
  for (int p = 0; p < active_count(); ++p) {
    const int slot = active(p);
    add_block(row_of(slot), 0, Omega_.block<2, 3>(row_of(p), 0));
    for (int q = 0; q < active_count(); ++q) {
      if (active(q) < slot)
        add_block(row_of(slot), row_of(active(q)), Omega_.block<2, 2>(row_of(p), row_of(q)));
    }
  }
  for (std::size_t k = 0; k < links_.size(); ++k) {
    const auto [i, j] = links_[k].end;
    if (position(i) != none && position(j) != none) continue;  // its block is the window's
    const Block& Omega_ij = links_[k].Omega_ij;
    add_block(row_of(std::max(i, j)), row_of(std::min(i, j)), i > j ? Omega_ij : Block(Omega_ij.transpose()));
  }
  const int size = row_of(landmark_count());
  Eigen::SparseMatrix<double> Omega(size, size);
  Omega.setFromTriplets(entries.begin(), entries.end());
  return Omega;
}

Eigen::VectorXd InformationState::full_mu() const {
  Eigen::VectorXd mu(row_of(landmark_count()));
  mu.head<3>() = mu_.head<3>();
  for (int slot = 0; slot < landmark_count(); ++slot) mu.segment<2>(row_of(slot)) = mean(slot);
  return mu;
}

Eigen::VectorXd InformationState::full_r() const {
  Eigen::VectorXd r(row_of(landmark_count()));
  r.head<3>() = r_.head<3>();
  for (int slot = 0; slot < landmark_count(); ++slot) r.segment<2>(row_of(slot)) = residual(slot);
  return r;
}

void InformationState::move_all(const Eigen::VectorXd& d) {
  move_robot(d.head<3>());
  for (int slot = 0; slot < landmark_count(); ++slot) move_landmark(slot, d.segment<2>(row_of(slot)));
}

}  // namespace seif
