#!/usr/bin/env python3
"""Grades JSON lines on a Spark cluster: each partition goes through one `carom grade --batch`.

    spark-submit examples/spark.py answers.jsonl grades [carom]

Lines are independent, so a task whose process or machine dies is simply run again. Every line comes back, broken ones with
the note INVALID_LINE; `id` says which is which. The number of a line in an `error` counts within its partition.
"""

import shlex
import sys

from pyspark.sql import SparkSession


def main(source: str, target: str, carom: str = "carom") -> None:
    spark = SparkSession.builder.appName("carom").getOrCreate()
    # Lines end at \\n alone, as JSON lines do; a stray carriage return belongs to its line.
    lines = spark.read.text(source, lineSep="\n").rdd.map(lambda row: row.value)
    # One thread each: Spark runs as many tasks as there are cores. A process that fails fails its task.
    grades = lines.pipe(f"{shlex.quote(carom)} grade --batch --jobs 1", checkCode=True)
    grades.saveAsTextFile(target)
    spark.stop()


if __name__ == "__main__":
    main(*sys.argv[1:])
