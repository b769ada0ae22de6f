#!/bin/bash
# Half a gigabyte of canonical CSV: a gyro at rest for ten hours at 200 Hz, warming and cooling.
#   tests/bench/big_csv.sh [ROWS] >big.csv
set -euo pipefail
awk -v rows="${1:-7500000}" 'BEGIN {
  print "t_s,imu_degc,gyro_x_dps,gyro_y_dps,gyro_z_dps,accel_x_g,accel_y_g,accel_z_g"
  for (i = 0; i < rows; i++) {
    n = i * 7919 % 1000 / 1e4 - 0.05
    printf "%.3f,%.5f,%.5f,%.5f,%.5f,%.5f,%.5f,%.5f\n", i / 200, 25 + 10 * sin(i / 4e5),
      0.8 + n, -1.1 - n, 0.35 + n, n / 9, -n / 9, 1 + n / 9
  }
}'
