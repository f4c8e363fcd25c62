#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace perifrac {

/// R rows by D columns, row by row: the gradient of an R-component field in D dimensions, or what
/// is conjugate to it.
template <int R, int D>
using Tensor = std::array<double, R * D>;

/// The notation of vectors and tensors for Vector<D> and Tensor<R, D>. Every sum starts at 0 and
/// adds in the order of the components: a formula has the bits of the loop that it stands for.

template <std::size_t N>
constexpr std::array<double, N>& operator+=(std::array<double, N>& a,
                                            const std::array<double, N>& b) {
  for (std::size_t k = 0; k < N; ++k) a[k] += b[k];
  return a;
}

template <std::size_t N>
constexpr std::array<double, N>& operator-=(std::array<double, N>& a,
                                            const std::array<double, N>& b) {
  for (std::size_t k = 0; k < N; ++k) a[k] -= b[k];
  return a;
}

template <std::size_t N>
constexpr std::array<double, N>& operator*=(std::array<double, N>& a, double s) {
  for (std::size_t k = 0; k < N; ++k) a[k] *= s;
  return a;
}

template <std::size_t N>
constexpr std::array<double, N> operator+(std::array<double, N> a, const std::array<double, N>& b) {
  return a += b;
}

template <std::size_t N>
constexpr std::array<double, N> operator-(std::array<double, N> a, const std::array<double, N>& b) {
  return a -= b;
}

template <std::size_t N>
constexpr std::array<double, N> operator-(std::array<double, N> a) {
  for (double& component : a) component = -component;
  return a;
}

template <std::size_t N>
constexpr std::array<double, N> operator*(double s, std::array<double, N> a) {
  return a *= s;
}

template <std::size_t N>
constexpr std::array<double, N> operator*(std::array<double, N> a, double s) {
  return a *= s;
}

template <std::size_t N>
constexpr std::array<double, N> operator/(std::array<double, N> a, double s) {
  for (double& component : a) component /= s;
  return a;
}

/// a_k b_k, with no sum: what a diagonal tensor makes of a vector.
template <std::size_t N>
constexpr std::array<double, N> componentwise(std::array<double, N> a,
                                              const std::array<double, N>& b) {
  for (std::size_t k = 0; k < N; ++k) a[k] *= b[k];
  return a;
}

template <std::size_t N>
constexpr double dot(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < N; ++k) sum += a[k] * b[k];
  return sum;
}

template <std::size_t N>
constexpr double squared_norm(const std::array<double, N>& a) {
  return dot(a, a);
}

template <std::size_t N>
double norm(const std::array<double, N>& a) {
  return std::sqrt(dot(a, a));
}

/// Out of the plane.
constexpr double cross(const std::array<double, 2>& a, const std::array<double, 2>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

constexpr std::array<double, 3> cross(const std::array<double, 3>& a,
                                      const std::array<double, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Turned by 90 degrees to the left.
constexpr std::array<double, 2> perpendicular(const std::array<double, 2>& a) {
  return {-a[1], a[0]};
}

/// How many rows a square tensor of N components has.
template <std::size_t N>
constexpr std::size_t rows_of = N == 9   ? 3
                                : N == 4 ? 2
                                         : 1;

/// Also of a tensor of packets, as is the next.
template <class Number, std::size_t N>
constexpr Number trace(const std::array<Number, N>& tensor) {
  static_assert(rows_of<N> * rows_of<N> == N);
  Number sum{};
  for (std::size_t a = 0; a < rows_of<N>; ++a) sum += tensor[a * rows_of<N> + a];
  return sum;
}

/// s times the unit tensor more.
template <class Number, std::size_t N>
constexpr void add_to_diagonal(std::array<Number, N>& tensor, const Number& s) {
  static_assert(rows_of<N> * rows_of<N> == N);
  for (std::size_t a = 0; a < rows_of<N>; ++a) tensor[a * rows_of<N> + a] += s;
}

/// The tensor times the vector, sum_b t_ab v_b.
template <std::size_t N>
constexpr std::array<double, N> operator*(const std::array<double, N * N>& tensor,
                                          const std::array<double, N>& v) {
  std::array<double, N> result{};
  for (std::size_t a = 0; a < N; ++a) {
    for (std::size_t b = 0; b < N; ++b) result[a] += tensor[a * N + b] * v[b];
  }
  return result;
}

/// The vector of place i in one array a component,
template <class Column, std::size_t N>
std::array<double, N> vector_at(const std::array<Column, N>& columns, std::size_t i) {
  std::array<double, N> v;
  for (std::size_t a = 0; a < N; ++a) v[a] = columns[a][i];
  return v;
}

/// in the first D of such arrays,
template <int D, class Columns>
std::array<double, D> vector_at(const Columns& columns, std::size_t i) {
  std::array<double, D> v;
  for (std::size_t a = 0; a < D; ++a) v[a] = columns[a][i];
  return v;
}

/// and in one array of blocks, a component after the other, of `count` places each.
template <int D, class Blocks>
std::array<double, D> vector_at(const Blocks& blocks, std::size_t count, std::size_t i) {
  std::array<double, D> v;
  for (std::size_t a = 0; a < D; ++a) v[a] = blocks[a * count + i];
  return v;
}

template <class Column, std::size_t N>
void set_at(std::array<Column, N>& columns, std::size_t i, const std::array<double, N>& v) {
  for (std::size_t a = 0; a < N; ++a) columns[a][i] = v[a];
}

template <class Blocks, std::size_t N>
void set_at(Blocks&& blocks, std::size_t count, std::size_t i, const std::array<double, N>& v) {
  for (std::size_t a = 0; a < N; ++a) blocks[a * count + i] = v[a];
}

template <class Column, std::size_t N>
void add_at(std::array<Column, N>& columns, std::size_t i, const std::array<double, N>& v) {
  for (std::size_t a = 0; a < N; ++a) columns[a][i] += v[a];
}

template <class Blocks, std::size_t N>
void add_at(Blocks&& blocks, std::size_t count, std::size_t i, const std::array<double, N>& v) {
  for (std::size_t a = 0; a < N; ++a) blocks[a * count + i] += v[a];
}

template <class Column, std::size_t N>
void append(std::array<Column, N>& columns, const std::array<double, N>& v) {
  for (std::size_t a = 0; a < N; ++a) columns[a].push_back(v[a]);
}

}  // namespace perifrac
