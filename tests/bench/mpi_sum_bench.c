/* mpi_sum_bench MIB REPETITIONS: how long ranks take to bring MIB mebibytes of 64-bit tallies each together on rank 0, as
 * distributed/mpi/mpi_sum.cpp does it, and in other ways. Rank 0 prints one JSON object; seconds are medians.
 *
 *   mpicc -O2 tests/bench/mpi_sum_bench.c -o mpi_sum_bench && mpirun -n 4 ./mpi_sum_bench 64 3
 */
#include <mpi.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { kBlock = 1 << 20, kMaxRepetitions = 99, kChainSegment = 1 << 14 }; /* numbers */

static int rank, ranks;

static void reduce(int64_t* values, size_t count, size_t block) {
  for (size_t at = 0; at < count; at += block) {
    const size_t left = count - at;
    const int n = (int)(left < block ? left : block);
    int64_t* here = values + at;
    MPI_Reduce(rank == 0 ? MPI_IN_PLACE : here, rank == 0 ? here : NULL, n, MPI_INT64_T, MPI_SUM, 0, MPI_COMM_WORLD);
  }
}

/* One MPI_Reduce a block. */
static void plain_reduce(int64_t* values, size_t count) { reduce(values, count, kBlock); }

/* mpi_sum.cpp: every rank adds up its share of a block, and rank 0 gathers the shares. (Open MPI 4.1 does MPI_Reduce_scatter_block for few
 * ranks as a whole reduce and a scatter; MPI_Reduce_scatter is a ring.) */
static void scatter_gather(int64_t* values, size_t count) {
  const size_t block = (size_t)kBlock * 4;
  int64_t* share = malloc(block * sizeof(int64_t));
  int* counts = malloc((size_t)ranks * sizeof(int));
  for (size_t at = 0; at < count; at += block) {
    const size_t here = count - at < block ? count - at : block;
    const int each = (int)(here / (size_t)ranks), rest = (int)(here - (size_t)each * (size_t)ranks);
    for (int r = 0; r < ranks; ++r) counts[r] = each;
    MPI_Reduce_scatter(values + at, share, counts, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    MPI_Gather(share, each, MPI_INT64_T, values + at, each, MPI_INT64_T, 0, MPI_COMM_WORLD);
    if (rest > 0) reduce(values + at + here - (size_t)rest, (size_t)rest, (size_t)rest);
  }
  free(counts);
  free(share);
}

/* Each rank adds what the next one sends and passes it on, a segment at a time: all links are busy at once. */
static void chain(int64_t* values, size_t count) {
  int64_t* in[2] = {malloc(kChainSegment * sizeof(int64_t)), malloc(kChainSegment * sizeof(int64_t))};
  MPI_Request receive[2], send = MPI_REQUEST_NULL;
  const size_t segments = (count + kChainSegment - 1) / kChainSegment;
  const int from = rank + 1 < ranks ? rank + 1 : MPI_PROC_NULL, to = rank > 0 ? rank - 1 : MPI_PROC_NULL;
  MPI_Irecv(in[0], kChainSegment, MPI_INT64_T, from, 0, MPI_COMM_WORLD, &receive[0]);
  for (size_t s = 0; s < segments; ++s) {
    const size_t at = s * kChainSegment, n = count - at < kChainSegment ? count - at : kChainSegment;
    if (s + 1 < segments)
      MPI_Irecv(in[(s + 1) % 2], kChainSegment, MPI_INT64_T, from, 0, MPI_COMM_WORLD, &receive[(s + 1) % 2]);
    MPI_Wait(&receive[s % 2], MPI_STATUS_IGNORE);
    if (from != MPI_PROC_NULL)
      for (size_t i = 0; i < n; ++i) values[at + i] += in[s % 2][i];
    MPI_Wait(&send, MPI_STATUS_IGNORE);
    MPI_Isend(values + at, (int)n, MPI_INT64_T, to, 0, MPI_COMM_WORLD, &send);
  }
  MPI_Wait(&send, MPI_STATUS_IGNORE);
  free(in[0]);
  free(in[1]);
}

static int by_value(const void* a, const void* b) {
  const double x = *(const double*)a, y = *(const double*)b;
  return (x > y) - (x < y);
}

static double median(double* values, int count) {
  qsort(values, (size_t)count, sizeof(double), by_value);
  return values[count / 2];
}

static void fill(int64_t* values, size_t count) {
  for (size_t i = 0; i < count; ++i) values[i] = (int64_t)i + rank;
}

/* Rank 0 has the result; the time is that of the rank that is done last. */
static double timed(void (*sum)(int64_t*, size_t), int64_t* values, size_t count, int repetitions) {
  double seconds[kMaxRepetitions];
  for (int k = 0; k < repetitions; ++k) {
    fill(values, count);
    MPI_Barrier(MPI_COMM_WORLD);
    const double start = MPI_Wtime();
    sum(values, count);
    const double mine = MPI_Wtime() - start;
    MPI_Allreduce(&mine, &seconds[k], 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    for (size_t i = 0; rank == 0 && i < count; ++i) {
      if (values[i] != (int64_t)i * ranks + (int64_t)ranks * (ranks - 1) / 2) {
        fprintf(stderr, "mpi_sum_bench: the sum is wrong at %zu\n", i);
        MPI_Abort(MPI_COMM_WORLD, 1);
      }
    }
  }
  return median(seconds, repetitions);
}

/* One number, as often as to be seen on the clock. */
static double latency(void) {
  enum { kTimes = 20 };
  int64_t value = rank;
  MPI_Barrier(MPI_COMM_WORLD);
  const double start = MPI_Wtime();
  for (int k = 0; k < kTimes; ++k) {
    reduce(&value, 1, 1);
    MPI_Barrier(MPI_COMM_WORLD);
  }
  return (MPI_Wtime() - start) / kTimes;
}

/* What adding alone costs, on rank 0, with the others waiting in a barrier that sleeps as little as MPI lets it. */
static double add_seconds_per_byte(int64_t* values, size_t count) {
  double seconds[5];
  const size_t half = count / 2;
  for (int k = 0; k < 5; ++k) {
    const double start = MPI_Wtime();
    MPI_Reduce_local(values, values + half, (int)half, MPI_INT64_T, MPI_SUM);
    seconds[k] = (MPI_Wtime() - start) / ((double)half * sizeof(int64_t));
  }
  return median(seconds, 5);
}

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const long mib = argc == 3 ? atol(argv[1]) : 0, repetitions = argc == 3 ? atol(argv[2]) : 0;
  if (mib < 1 || mib > 1024 || repetitions < 1 || repetitions > kMaxRepetitions) {
    if (rank == 0) fprintf(stderr, "usage: mpi_sum_bench MIB REPETITIONS\n");
    MPI_Finalize();
    return 2;
  }
  const size_t count = (size_t)mib << 17;
  int64_t* values = malloc(count * sizeof(int64_t));
  fill(values, count);
  const int n = (int)repetitions;
  const double built = timed(plain_reduce, values, count, n), pieces = timed(scatter_gather, values, count, n);
  const double line = timed(chain, values, count, n), one = latency();
  const double add = ranks == 1 ? add_seconds_per_byte(values, count) : 0;
  if (rank == 0)
    printf("{\"ranks\": %d, \"mib\": %ld, \"reduce_s\": %.6f, \"scatter_gather_s\": %.6f, \"chain_s\": %.6f, "
           "\"latency_s\": %.9f, \"add_s_per_byte\": %.4e}\n", ranks, mib, built, pieces, line, one, add);
  free(values);
  MPI_Finalize();
  return 0;
}
