#include "seif/information_state.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace seif {

InformationState::InformationState(const PoseEstimate& start) : first_estimates_(start.mean) {
  const Eigen::LLT<Eigen::Matrix3d> llt(start.covariance);
  if (llt.info() != Eigen::Success) {
    throw std::invalid_argument("the covariance of the start estimate is not positive definite");
  }
  reserve_window(8);
  Omega_.topLeftCorner<3, 3>() = llt.solve(Eigen::Matrix3d::Identity());
  mu_.head<3>() << start.mean.x, start.mean.y, start.mean.theta;
}

void InformationState::mark_seen(int slot) {
  Landmark& landmark = graph_.landmark(slot);
  if (landmark.sightings == 0 || landmark.last_seen != scan_) ++landmark.sightings;
  landmark.last_seen = scan_;
}

Eigen::Vector2d InformationState::mean(int slot) const {
  const Landmark& landmark = graph_.landmark(slot);
  if (landmark.position == none) return landmark.mu;
  return mu_.segment<2>(row_of(landmark.position));
}

Eigen::Vector2d InformationState::residual(int slot) const {
  const Landmark& landmark = graph_.landmark(slot);
  if (landmark.position == none) return landmark.r;
  return r_.segment<2>(row_of(landmark.position));
}

Eigen::Matrix2d InformationState::information(int slot) const {
  const Landmark& landmark = graph_.landmark(slot);
  if (landmark.position == none) return landmark.Omega_ii;
  const int row = row_of(landmark.position);
  return Omega_.block<2, 2>(row, row) + frozen_.block<2, 2>(row, row);
}

int InformationState::add_landmark(LandmarkId landmark, const Eigen::Vector2d& mean, bool is_settled) {
  const int slot = landmark_count();
  if (landmark >= 0) index_.insert(landmark, slot);
  graph_.add_landmark(landmark, mean);
  if (is_settled) graph_.landmark(slot).sightings = first_estimates_.settled_after() + 1;
  first_estimates_.add(first_estimates_.framed(mean, pose()));
  return slot;
}

int InformationState::activate(int slot) {
  assert(position(slot) == none);
  const int position = active_count();
  reserve_window(position + 1);
  active_.push_back(slot);
  load_into_window(slot, position);
  graph_.landmark(slot).position = position;
  return position;
}

void InformationState::load_into_window(int slot, int position) {
  Landmark& landmark = graph_.landmark(slot);
  squared_residual_ -= std::exchange(landmark.squared_residual, 0.0);
  const int row = row_of(position);
  for (Eigen::MatrixXd* M : {&Omega_, &frozen_}) {
    M->middleRows<2>(row).leftCols(row + 2).setZero();
    M->middleCols<2>(row).topRows(row + 2).setZero();
  }
  stored().block<2, 2>(row, row) = landmark.Omega_ii;
  mu_.segment<2>(row) = landmark.mu;
  r_.segment<2>(row) = landmark.r;
  link_of_.row(position).head(position + 1).setConstant(none);
  link_of_.col(position).head(position + 1).setConstant(none);
  graph_.for_each_link(slot, [&](int link, int end, int other) {
    const int other_position = graph_.landmark(other).position;
    if (other_position == none) return;
    const int other_row = row_of(other_position);
    const Block Omega_so = graph_.block(link, end);
    stored().block<2, 2>(row, other_row) = Omega_so;
    stored().block<2, 2>(other_row, row) = Omega_so.transpose();
    link_of_(position, other_position) = link_of_(other_position, position) = link;
    touch(1);
  });
  touch(1);
}

void InformationState::deactivate(int position) {
  const int slot = active(position);
  assert(Omega_.block(0, row_of(position), 3, 2).isZero(0.0));
  store_from_window(position);
  graph_.landmark(slot).position = none;
  const int last = active_count() - 1;
  if (position != last) move_within_window(last, position);
  active_.pop_back();
}

void InformationState::store_from_window(int position) {
  const int slot = active(position);
  const int row = row_of(position);
  Landmark& landmark = graph_.landmark(slot);
  landmark.mu = mu_.segment<2>(row);
  landmark.r = r_.segment<2>(row);
  landmark.Omega_ii = stored().block<2, 2>(row, row);
  note_residual(landmark);
  for (int other = 0; other < active_count(); ++other) {
    if (other == position) continue;
    const Block Omega_so = stored().block<2, 2>(row, row_of(other));
    if (const int link = link_of_(position, other); link != none) {
      graph_.set_block(link, slot, Omega_so);
    } else if (!Omega_so.isZero(0.0)) {
      graph_.add_link(slot, active(other), Omega_so);
    }
  }
  touch(active_count());
}

void InformationState::move_within_window(int from, int to) {
  const int size = window_size();
  const int from_row = row_of(from);
  const int to_row = row_of(to);
  for (Eigen::MatrixXd* M : {&Omega_, &frozen_}) {
    M->middleRows<2>(to_row).leftCols(size) = M->middleRows<2>(from_row).leftCols(size);
    M->middleCols<2>(to_row).topRows(size) = M->middleCols<2>(from_row).topRows(size);
    M->block<2, 2>(to_row, to_row) = M->block<2, 2>(from_row, from_row);
  }
  mu_.segment<2>(to_row) = mu_.segment<2>(from_row);
  r_.segment<2>(to_row) = r_.segment<2>(from_row);
  link_of_.row(to).head(active_count()) = link_of_.row(from).head(active_count());
  link_of_.col(to).head(active_count()) = link_of_.col(from).head(active_count());
  link_of_(to, to) = none;
  active_[static_cast<std::size_t>(to)] = active_[static_cast<std::size_t>(from)];
  graph_.landmark(active(to)).position = to;
}

void InformationState::reserve_window(int active_landmarks) {
  const int room = static_cast<int>(link_of_.rows());
  if (active_landmarks <= room) return;
  const int new_room = std::max(active_landmarks, 2 * room);
  const int rows = row_of(new_room);
  Omega_.conservativeResizeLike(Eigen::MatrixXd::Zero(rows, rows));
  frozen_.conservativeResizeLike(Eigen::MatrixXd::Zero(rows, rows));
  work_.resize(rows, rows);
  work_columns_.resize(rows, 3);
  wide_columns_.resize(rows, Eigen::Index{2} * rows);
  mu_.conservativeResizeLike(Eigen::VectorXd::Zero(rows));
  r_.conservativeResizeLike(Eigen::VectorXd::Zero(rows));
  link_of_.conservativeResizeLike(Eigen::MatrixXi::Constant(new_room, new_room, none));
  active_.reserve(static_cast<std::size_t>(new_room));
}

void InformationState::move_robot(const Eigen::Vector3d& d) {
  mu_.head<3>() += d;
  mu_(2) = wrap_angle(mu_(2));
  r().noalias() -= Omega().leftCols<3>() * d;
  touch(active_count() + 1);
}

void InformationState::move_landmark(int slot, const Eigen::Vector2d& d) {
  Landmark& landmark = graph_.landmark(slot);
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
  graph_.for_each_link(slot, [&](int link, int end, int other) {
    Landmark& neighbour = graph_.landmark(other);
    if (landmark.position != none && neighbour.position != none) return;  // its block is the window's
    const Block& Omega_ij = graph_.stored_block(link);
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
    graph_.for_each_link(active(position), [&](int link, int end, int other) {
      Landmark& neighbour = graph_.landmark(other);
      if (neighbour.position != none) return;  // its block is the window's
      const Block& Omega_ij = graph_.stored_block(link);
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
  graph_.landmark(slot).mu = mean;
}

/// To be called for a passive landmark whose r has changed.
void InformationState::note_residual(Landmark& landmark) {
  if (!tracks_residual_) return;
  const double now = landmark.r.dot(landmark.Omega_ii.inverse() * landmark.r);
  squared_residual_ += now - std::exchange(landmark.squared_residual, now);
}

std::optional<double> InformationState::squared_residual() const {
  const Eigen::Vector3d r_x = r_.head<3>();
  const Eigen::LLT<Eigen::Matrix3d> Omega_xx(Omega_.topLeftCorner<3, 3>());
  if (Omega_xx.info() != Eigen::Success) return std::nullopt;
  double sum = squared_residual_ + r_x.dot(Omega_xx.solve(r_x));
  for (int position = 0; position < active_count(); ++position) {
    const int row = row_of(position);
    const Eigen::Vector2d r_i = r_.segment<2>(row);
    sum += r_i.dot(Omega_.block<2, 2>(row, row).inverse() * r_i);
  }
  return sum;
}

std::int64_t InformationState::link_count() const {
  std::int64_t links = active_count() + graph_.link_count();
  for (int i = 0; i < active_count(); ++i) {
    for (int j = 0; j < i; ++j) {
      if (link_of_(i, j) != none) continue;
      const bool is_linked = !Omega_.block<2, 2>(row_of(i), row_of(j)).isZero(0.0) ||
                             !frozen_.block<2, 2>(row_of(i), row_of(j)).isZero(0.0);
      if (is_linked) ++links;
    }
  }
  return links;
}

std::size_t InformationState::memory_bytes() const {
  return graph_.memory_bytes() + index_.memory_bytes() + first_estimates_.memory_bytes() +
         sizeof(double) * static_cast<std::size_t>(5 * Omega_.size() + 2 * mu_.size() + 3 * mu_.size()) +
         sizeof(int) * (static_cast<std::size_t>(link_of_.size()) + active_.capacity());
}

}  // namespace seif
