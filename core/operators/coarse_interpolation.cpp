#include "core/operators/coarse_interpolation.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/for_each_point.hpp"
#include "core/base/small_vector.hpp"
#include "core/bonds/crack_cut.hpp"

namespace perifrac {

namespace {

/// Cells of all nodes of the coarse body: ghosts lie in the images of their sources' cells.
template <int D>
class NodeCells {
 public:
  NodeCells(const CoarseBody<D>& coarse, const Family<D>& family) {
    const Points<D>& points = coarse.body->points();
    std::vector<std::array<Index, D>> cells = coarse.cell_of;
    for (Index g = 0; g < family.ghost_count(); ++g) {
      const Index source = family.ghost_source[g];
      std::array<Index, D> cell = coarse.cell_of[source];
      for (int a = 0; a < D; ++a) {
        if (((family.ghost_axes[g] >> a) & 1) == 0) continue;
        const bool below = family.position[a][family.point_count + g] < points.position[a][source];
        cell[a] = (below ? -1 : 2 * coarse.cells[a] - 1) - cell[a];
      }
      cells.push_back(cell);
    }
    std::size_t size = 1;
    for (int a = 0; a < D; ++a) {
      const auto along = [a](const auto& cell) { return cell[a]; };
      first_[a] = std::ranges::min(cells, {}, along)[a];
      count_[a] = std::ranges::max(cells, {}, along)[a] - first_[a] + 1;
      size *= count_[a];
      layer_[a].assign(count_[a], 0.0);
      std::vector<Index> members(count_[a], 0);
      for (std::size_t node = 0; node < cells.size(); ++node) {
        layer_[a][cells[node][a] - first_[a]] += family.position[a][node];
        ++members[cells[node][a] - first_[a]];
      }
      for (Index k = 0; k < count_[a]; ++k) layer_[a][k] /= members[k];
    }
    node_in_.assign(size, -1);
    for (std::size_t node = 0; node < cells.size(); ++node) {
      node_in_[place(cells[node])] = static_cast<Index>(node);
    }
  }

  /// The node in a cell; -1: there is none.
  Index node(const std::array<Index, D>& cell) const {
    for (int a = 0; a < D; ++a) {
      if (cell[a] < first_[a] || cell[a] >= first_[a] + count_[a]) return -1;
    }
    return node_in_[place(cell)];
  }

  /// The layer beside layer k that a coordinate lies towards, and its weight.
  std::pair<Index, double> beside(int a, Index k, double x) const {
    const double own = layer_[a][k - first_[a]];
    const Index other = x < own ? k - 1 : k + 1;
    if (other < first_[a] || other >= first_[a] + count_[a]) return {other, 0.0};
    return {other, std::abs((x - own) / (layer_[a][other - first_[a]] - own))};
  }

 private:
  std::size_t place(const std::array<Index, D>& cell) const {
    std::size_t at = 0;
    for (int a = D - 1; a >= 0; --a) at = at * count_[a] + (cell[a] - first_[a]);
    return at;
  }

  std::array<Index, D> first_, count_;
  std::array<std::vector<double>, D> layer_;  ///< mean coordinate, by cell along the axis [m]
  std::vector<Index> node_in_;                ///< by cell
};

}  // namespace

template <int D>
CoarseInterpolation<D>::CoarseInterpolation(const Points<D>& fine, const CoarseBody<D>& coarse,
                                            const Family<D>& family, MirrorCondition<D, D> mirror)
    : mirror_(std::move(mirror)),
      coarse_points_(family.point_count),
      fine_points_(fine.size()),
      nodes_(family.node_count()),
      node_values_(static_cast<std::size_t>(D) * family.node_count()) {
  const NodeCells<D> cells(coarse, family);
  for (Index i = 0; i < fine_points_; ++i) {
    const Index own = coarse.coarse_of[i];
    const std::array<Index, D>& cell = coarse.cell_of[own];
    std::array<std::pair<Index, double>, D> beside;
    for (int a = 0; a < D; ++a) beside[a] = cells.beside(a, cell[a], fine.position[a][i]);
    const std::size_t first = from_nodes_.column.size();
    from_nodes_.column.push_back(own);
    from_nodes_.weight.push_back(0.0f);
    double left = 1.0;
    for (int corner = 1; corner < 1 << D; ++corner) {
      double weight = 1.0;
      std::array<Index, D> at = cell;
      for (int a = 0; a < D; ++a) {
        const bool over = ((corner >> a) & 1) != 0;
        weight *= over ? beside[a].second : 1.0 - beside[a].second;
        if (over) at[a] = beside[a].first;
      }
      const Index node = weight > 0.0 ? cells.node(at) : -1;
      if (node < 0) continue;
      from_nodes_.column.push_back(node);
      from_nodes_.weight.push_back(static_cast<float>(weight));
      left -= from_nodes_.weight.back();
    }
    from_nodes_.weight[first] = static_cast<float>(left);
    from_nodes_.begin.push_back(static_cast<Index>(from_nodes_.column.size()));
  }
  to_nodes_ = transpose(from_nodes_, nodes_);
}

template <int D>
auto CoarseInterpolation<D>::transpose(const Rows& rows, Index columns) -> Rows {
  Rows result{.begin = std::vector<Index>(columns + 1, 0),
              .column = std::vector<Index>(rows.column.size()),
              .weight = std::vector<float>(rows.column.size())};
  for (const Index column : rows.column) ++result.begin[column + 1];
  for (Index k = 0; k < columns; ++k) result.begin[k + 1] += result.begin[k];
  std::vector<Index> next(result.begin.begin(), result.begin.end() - 1);
  for (Index row = 0; row < rows.count(); ++row) {
    for (Index k = rows.begin[row]; k < rows.begin[row + 1]; ++k) {
      const Index place = next[rows.column[k]]++;
      result.column[place] = row;
      result.weight[place] = rows.weight[k];
    }
  }
  return result;
}

template <int D>
float& CoarseInterpolation<D>::Rows::at(Index row, Index wanted) {
  const auto first = column.begin() + begin[row];
  const auto found = std::find(first, column.begin() + begin[row + 1], wanted);
  return weight[found - column.begin()];
}

/// What is left of a point's weights is scaled to be 1 again, as if the nearest coarse layer on its
/// own side stood for the one behind the crack.
template <int D>
void CoarseInterpolation<D>::cut(const CrackFacet<D>& facet, const Points<D>& fine,
                                 const Family<D>& family, double reach) {
  const Vector<D> centre = middle<D>(facet);
  const double far = norm(facet[0] - centre) + reach;
  for (Index i = 0; i < fine_points_; ++i) {
    const Vector<D> x = fine.at(i);
    if (squared_norm(x - centre) > far * far) continue;
    const auto is_behind = [&](Index k) {
      const Index node = from_nodes_.column[k];
      const Index point = node < coarse_points_ ? node : family.ghost_source[node - coarse_points_];
      return is_cut<D>(facet, x, vector_at(family.position, point));
    };
    float lost = 0.0f, all = 0.0f;
    std::vector<Index> behind;
    for (Index k = from_nodes_.begin[i]; k < from_nodes_.begin[i + 1]; ++k) {
      all += from_nodes_.weight[k];
      if (from_nodes_.weight[k] == 0.0f || !is_behind(k)) continue;
      lost += from_nodes_.weight[k];
      behind.push_back(k);
    }
    if (behind.empty() || all - lost < 0.01f) continue;
    for (const Index k : behind) from_nodes_.weight[k] = 0.0f;
    for (Index k = from_nodes_.begin[i]; k < from_nodes_.begin[i + 1]; ++k) {
      from_nodes_.weight[k] *= all / (all - lost);
      to_nodes_.at(from_nodes_.column[k], i) = from_nodes_.weight[k];
    }
  }
}

template <int D>
void CoarseInterpolation<D>::Rows::multiply(const double* from, double* to, bool adds) const {
  for_each_point(count(), [&](Index row) {
    double sum = adds ? to[row] : 0.0;
    for (Index k = begin[row]; k < begin[row + 1]; ++k) sum += weight[k] * from[column[k]];
    to[row] = sum;
  });
}

template <int D>
void CoarseInterpolation<D>::add(const Eigen::VectorXd& coarse, Eigen::VectorXd& fine) const {
  mirror_.spread({coarse.data(), static_cast<std::size_t>(coarse.size())}, node_values_);
  for (int a = 0; a < D; ++a) {
    from_nodes_.multiply(node_values_.data() + static_cast<std::size_t>(a) * nodes_,
                         fine.data() + static_cast<std::size_t>(a) * fine_points_, true);
  }
  const int faces = mirror_.face_value_count();
  fine.tail(faces) += coarse.tail(faces);
}

template <int D>
void CoarseInterpolation<D>::restrict(const Eigen::VectorXd& fine, Eigen::VectorXd& coarse) const {
  for (int a = 0; a < D; ++a) {
    to_nodes_.multiply(fine.data() + static_cast<std::size_t>(a) * fine_points_,
                       node_values_.data() + static_cast<std::size_t>(a) * nodes_, false);
  }
  const int faces = mirror_.face_value_count();
  mirror_.collect(node_values_, {coarse.data(), static_cast<std::size_t>(coarse.size())});
  coarse.tail(faces) += fine.tail(faces);
}

template <int D>
std::size_t CoarseInterpolation<D>::bytes() const {
  std::size_t sum = node_values_.capacity() * sizeof(double);
  for (const Rows* rows : {&from_nodes_, &to_nodes_}) {
    sum += rows->begin.capacity() * sizeof(Index) + rows->column.capacity() * sizeof(Index) +
           rows->weight.capacity() * sizeof(float);
  }
  return sum;
}

template class CoarseInterpolation<2>;
template class CoarseInterpolation<3>;

}  // namespace perifrac
