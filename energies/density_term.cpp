#include "majorant/energies/density_term.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace majorant {

static_assert(ChunkView::stride == Chunk::kMaxSize && ChunkView::stride == LocalSystem::stride);

DensityTerm::DensityTerm(std::string name, std::shared_ptr<const ElementSpace> space,
                         const RestShapes& rest, const std::vector<Quadrature>& rules,
                         std::shared_ptr<const void> density, const DensityKernels& kernels)
    : name_(std::move(name)),
      space_(std::move(space)),
      density_(std::move(density)),
      kernels_(kernels) {
  if (rules.empty()) throw std::invalid_argument("DensityTerm: no quadrature rule");
  if (rest.measure.size() != space_->element_count())
    throw std::invalid_argument("DensityTerm: rest shapes do not fit the space");
  stencils_.nodes = space_->cells();
  stencils_.block = 2;
  rest_.resize(5, space_->element_count());
  for (Index e = 0; e < space_->element_count(); ++e) {
    const auto m = rest.inverse_of(e);
    rest_.col(e) << m(0, 0), m(0, 1), m(1, 0), m(1, 1), rest.measure[e];
  }
  for (const Quadrature& q : rules) {
    rules_.push_back(std::make_unique<Rule>());
    rules_.back()->quadrature = q;
  }
}

const DensityTerm::Rule& DensityTerm::rule(RuleId id) const {
  Rule& r = *rules_[static_cast<std::size_t>(id)];
  std::call_once(r.built, [&] {
    r.table = space_->tabulate(r.quadrature);
    r.weighted_first = r.table.weights.asDiagonal() * r.table.first;
    r.weighted_moment = r.table.weights.asDiagonal() * r.table.moment;
  });
  return r;
}

ContractionView DensityTerm::Rule::view() const {
  ContractionView v{};
  v.nodes = table.nodes;
  v.points = static_cast<int>(table.weights.size());
  v.first_count = static_cast<int>(table.first.cols());
  v.moment_count = static_cast<int>(table.moment.cols());
  v.direction_count = static_cast<int>(table.directions.rows());
  v.gradient_count = static_cast<int>(table.gradient.size());
  v.directions = table.directions.data();
  v.weights = table.weights.data();
  v.first = table.first.data();
  v.weighted_first = weighted_first.data();
  v.weighted_moment = weighted_moment.data();
  v.gradient = table.gradient.data();
  v.hessian = table.hessian.data();
  v.pair_starts = table.pair_starts.data();
  return v;
}

DensityTerm::Gathered DensityTerm::gather(VecIn x, const Chunk& chunk, const ContractionView& table,
                                          Workspace& w) const {
  constexpr int stride = ChunkView::stride;
  const int rows = stencils_.local_size();
  const auto count = static_cast<int>(chunk.elements.size());
  const auto total = static_cast<std::size_t>((rows + 6) * stride + kernels_.scratch_size(table));
  double* memory = w.reserve(total);
  double* rest = memory + rows * stride;
  const int padded = (count + 7) / 8 * 8;
  for (int p = 0; p < padded; ++p) {
    const Index e = chunk.elements[static_cast<std::size_t>(std::min(p, count - 1))];
    for (int k = 0; k < rows / 2; ++k) {
      const Index node = stencils_.nodes(e, k);
      memory[2 * k * stride + p] = x[2 * node];
      memory[(2 * k + 1) * stride + p] = x[2 * node + 1];
    }
    for (int k = 0; k < 5; ++k) rest[k * stride + p] = rest_(k, e);
  }
  double* values = rest + 5 * stride;
  return {{count, memory, rest}, values + stride, values};
}

void DensityTerm::values(VecIn x, const Chunk& chunk, const TermState&, Workspace& workspace,
                         std::span<double> f) const {
  if (chunk.elements.empty()) return;
  const ContractionView table = rule(chunk.rule).view();
  const Gathered g = gather(x, chunk, table, workspace);
  kernels_.values(density_.get(), table, g.chunk, g.scratch, g.values);
  std::copy_n(g.values, chunk.elements.size(), f.begin());
}

void DensityTerm::local(VecIn x, const Chunk& chunk, Curvature curvature, const TermState&,
                        Workspace& workspace, LocalSystem& out) const {
  if (chunk.elements.empty()) return;
  const ContractionView table = rule(chunk.rule).view();
  const Gathered g = gather(x, chunk, table, workspace);
  kernels_.local(density_.get(), table, g.chunk, curvature, g.scratch, out.value, out.gradient,
                 out.hessian);
}

}  // namespace majorant
