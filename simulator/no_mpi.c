/* Debian 13 compiles the core of SUNDIALS with MPI. Without a communicator, and Gyre gives none, the core calls nothing
   of it; but the linker wants the names. The real ones come with 44 packages of 270 MB, compilers for graphics cards
   among them. */

#include <stdlib.h>

/* Compared with by address only. */
char ompi_mpi_comm_null, ompi_mpi_double, ompi_mpi_long;

#define GYRE_NO_MPI(name) \
  int name(void) {        \
    abort();              \
  }

GYRE_NO_MPI(MPI_Abort)
GYRE_NO_MPI(MPI_Comm_dup)
GYRE_NO_MPI(MPI_Comm_free)
GYRE_NO_MPI(MPI_Comm_rank)
GYRE_NO_MPI(MPI_Comm_size)
GYRE_NO_MPI(MPI_Op_create)
GYRE_NO_MPI(MPI_Op_free)
GYRE_NO_MPI(MPI_Reduce)
GYRE_NO_MPI(MPI_Type_commit)
GYRE_NO_MPI(MPI_Type_create_resized)
GYRE_NO_MPI(MPI_Type_create_struct)
GYRE_NO_MPI(MPI_Type_free)
GYRE_NO_MPI(MPI_Type_get_extent)
