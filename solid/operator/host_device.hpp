#pragma once
// Private to the sources of this layer.

/// Marks functions that are compiled for a device, too, where the compiler has one.
#if defined(__CUDACC__) || defined(__HIPCC__)
#define ABUT_HOST_DEVICE __host__ __device__
#else
#define ABUT_HOST_DEVICE
#endif
