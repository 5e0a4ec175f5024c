#include "simulator/core/load_integrator.hpp"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <string>

#include "common/base/ensure.hpp"

namespace gyre::simulator {
namespace {

constexpr sunindextype kStates = StateVector::RowsAtCompileTime;
constexpr double kRelativeTolerance = 1e-7;
constexpr double kPositionTolerance_m = 1e-10;
constexpr double kVelocityTolerance_m_s = 1e-9;
constexpr double kAttitudeTolerance = 1e-10;
constexpr double kSpinTolerance_rad_s = 1e-9;
/// One call covers a tick online and a period offline; more steps than this means that it does not get on.
constexpr long kMaxSteps = 20000;
/// A cable that snaps taut is a jump of the force; finding it takes more halvings than CVODE allows by default.
constexpr int kMaxFailures = 50;

// SUNDIALS 7 (Debian 13) has a name for the communicator that 6 (Debian 12) takes as a null pointer, and sends its
// complaints by context where 6 sends them by integrator. Left alone, both write to the standard error stream; a core
// does not.
#if SUNDIALS_VERSION_MAJOR >= 7
SUNComm no_communicator() {
  return SUN_COMM_NULL;
}
void remember(int /*line*/, const char* /*function*/, const char* /*file*/, const char* text, SUNErrCode /*code*/,
              void* complaint, SUNContext /*context*/) {
  *static_cast<std::string*>(complaint) = text;
}
int send_complaints(SUNContext context, void* /*cvode*/, std::string& to) {
  SUNContext_ClearErrHandlers(context);  // the one that writes
  return SUNContext_PushErrHandler(context, &remember, &to);
}
#else
void* no_communicator() {
  return nullptr;
}
void remember(int /*code*/, const char* /*module*/, const char* /*function*/, char* text, void* complaint) {
  *static_cast<std::string*>(complaint) = text;
}
int send_complaints(SUNContext /*context*/, void* cvode, std::string& to) {
  return CVodeSetErrHandlerFn(cvode, &remember, &to);
}
#endif

struct FreeContext {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
};
struct FreeVector {
  void operator()(N_Vector vector) const { N_VDestroy(vector); }
};
struct FreeMatrix {
  void operator()(SUNMatrix matrix) const { SUNMatDestroy(matrix); }
};
struct FreeLinearSolver {
  void operator()(SUNLinearSolver solver) const { SUNLinSolFree(solver); }
};
struct FreeCvode {
  void operator()(void* memory) const { CVodeFree(&memory); }
};

template <class Pointer, class Free>
using Owned = std::unique_ptr<std::remove_pointer_t<Pointer>, Free>;

SUNContext new_context() {
  SUNContext context = nullptr;
  GYRE_ENSURE(SUNContext_Create(no_communicator(), &context) == 0, "SUNDIALS gives a context");
  return context;
}

Eigen::Map<StateVector> state_of(N_Vector vector) {
  return Eigen::Map<StateVector>(N_VGetArrayPointer(vector));
}

}  // namespace

struct LoadIntegrator::Solver {
  Solver(LoadDynamics model, const LoadMotion& start, double start_s, SurroundingsAt surroundings_at)
      : dynamics(std::move(model)),
        surroundings(std::move(surroundings_at)),
        motion(start),
        time_s(start_s),
        context(new_context()),
        state(N_VNew_Serial(kStates, context.get())),
        tolerance(N_VNew_Serial(kStates, context.get())),
        matrix(SUNDenseMatrix(kStates, kStates, context.get())),
        linear(SUNLinSol_Dense(state.get(), matrix.get(), context.get())),
        cvode(CVodeCreate(CV_BDF, context.get())) {
    now.anchors.resize(dynamics.load().attachments_b_m.size());
    state_of(state.get()) = dynamics.pack(start);
    state_of(tolerance.get()) << Eigen::Vector3d::Constant(kPositionTolerance_m),
        Eigen::Vector3d::Constant(kVelocityTolerance_m_s), Eigen::Vector4d::Constant(kAttitudeTolerance),
        Eigen::Vector3d::Constant(kSpinTolerance_rad_s);
    // None of these can fail but by a mistake of ours.
    const bool ready = CVodeInit(cvode.get(), &derivative, start_s, state.get()) == CV_SUCCESS &&
                       CVodeSVtolerances(cvode.get(), kRelativeTolerance, tolerance.get()) == CV_SUCCESS &&
                       CVodeSetLinearSolver(cvode.get(), linear.get(), matrix.get()) == CV_SUCCESS &&
                       CVodeSetJacFn(cvode.get(), &jacobian) == CV_SUCCESS &&
                       CVodeSetUserData(cvode.get(), this) == CV_SUCCESS &&
                       send_complaints(context.get(), cvode.get(), complaint) == CV_SUCCESS &&
                       CVodeSetMaxNumSteps(cvode.get(), kMaxSteps) == CV_SUCCESS &&
                       CVodeSetMaxErrTestFails(cvode.get(), kMaxFailures) == CV_SUCCESS &&
                       CVodeSetMaxConvFails(cvode.get(), kMaxFailures) == CV_SUCCESS;
    GYRE_ENSURE(ready, "CVODE takes its settings");
  }

  static int derivative(double t_s, N_Vector y, N_Vector dy, void* user) {
    auto& self = *static_cast<Solver*>(user);
    self.surroundings(t_s, self.now);
    self.dynamics.derivative(state_of(y), self.now, state_of(dy));
    // A positive value asks CVODE for a shorter step.
    return state_of(dy).allFinite() ? 0 : 1;
  }

  static int jacobian(double t_s, N_Vector y, N_Vector /*dy*/, SUNMatrix out, void* user, N_Vector /*t1*/,
                      N_Vector /*t2*/, N_Vector /*t3*/) {
    auto& self = *static_cast<Solver*>(user);
    self.surroundings(t_s, self.now);
    Eigen::Map<StateMatrix> matrix(SUNDenseMatrix_Data(out));
    self.dynamics.jacobian(state_of(y), self.now, matrix);
    return matrix.allFinite() ? 0 : 1;
  }

  /// True when it got there.
  bool integrate(double t_s) {
    if (CVodeSetStopTime(cvode.get(), t_s) < 0) return false;
    double reached_s = t_s;
    return CVode(cvode.get(), t_s, state.get(), &reached_s, CV_NORMAL) >= 0 && state_of(state.get()).allFinite();
  }

  void restart(const StateVector& from, double t_s) {
    // CVODE counts from its last initialisation; ours count from the beginning.
    past = statistics();
    state_of(state.get()) = from;
    GYRE_ENSURE(CVodeReInit(cvode.get(), t_s, state.get()) == CV_SUCCESS, "CVODE starts afresh");
  }

  [[nodiscard]] IntegratorStatistics statistics() const {
    IntegratorStatistics out;
    CVodeGetNumSteps(cvode.get(), &out.steps);
    CVodeGetNumRhsEvals(cvode.get(), &out.evaluations);
    out.steps += past.steps;
    out.evaluations += past.evaluations;
    return out;
  }

  LoadDynamics dynamics;
  SurroundingsAt surroundings;
  Surroundings now;
  LoadMotion motion;
  double time_s = 0.0;
  std::string complaint;
  IntegratorStatistics past;

  // In this order: what is used is declared before what uses it, and so outlives it.
  Owned<SUNContext, FreeContext> context;
  Owned<N_Vector, FreeVector> state;
  Owned<N_Vector, FreeVector> tolerance;
  Owned<SUNMatrix, FreeMatrix> matrix;
  Owned<SUNLinearSolver, FreeLinearSolver> linear;
  std::unique_ptr<void, FreeCvode> cvode;
};

LoadIntegrator::LoadIntegrator(LoadDynamics dynamics, const LoadMotion& start, double start_s,
                               SurroundingsAt surroundings)
    : solver_(std::make_unique<Solver>(std::move(dynamics), start, start_s, std::move(surroundings))) {}

LoadIntegrator::~LoadIntegrator() = default;

std::optional<Error> LoadIntegrator::advance_to(double t_s) {
  Solver& s = *solver_;
  if (t_s <= s.time_s) return std::nullopt;
  if (!s.integrate(t_s)) {
    s.restart(s.dynamics.pack(s.motion), s.time_s);
    if (!s.integrate(t_s)) {
      s.restart(s.dynamics.pack(s.motion), s.time_s);
      return Error{"the load's motion cannot be integrated from " + std::to_string(s.time_s) + " s to " +
                   std::to_string(t_s) + " s: " + s.complaint +
                   "; look for setpoints that jump, or for cables far stiffer than the load is heavy"};
    }
  }
  s.time_s = t_s;
  s.motion = s.dynamics.unpack(state_of(s.state.get()));
  return std::nullopt;
}

void LoadIntegrator::restart(const LoadMotion& motion, double t_s) {
  solver_->motion = motion;
  solver_->time_s = t_s;
  solver_->restart(solver_->dynamics.pack(motion), t_s);
}

double LoadIntegrator::time_s() const {
  return solver_->time_s;
}
const LoadMotion& LoadIntegrator::motion() const {
  return solver_->motion;
}
const LoadDynamics& LoadIntegrator::dynamics() const {
  return solver_->dynamics;
}
IntegratorStatistics LoadIntegrator::statistics() const {
  return solver_->statistics();
}

}  // namespace gyre::simulator
