#include "modules/pore_flow/make_flow.hpp"

namespace perifrac {

template class LinearExactOperator<2, DarcyLaw<2>>;
template class LinearExactOperator<3, DarcyLaw<3>>;
template std::unique_ptr<FlowOperator<2>> make_flow(FlowScheme,
                                                    LinearExactOperator<2, DarcyLaw<2>>);
template std::unique_ptr<FlowOperator<3>> make_flow(FlowScheme,
                                                    LinearExactOperator<3, DarcyLaw<3>>);

}  // namespace perifrac
