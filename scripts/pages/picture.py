#!/usr/bin/env python3
"""A curve of a report of `vuris diagnose --report` as a picture of its own: picture.py REPORT.html "time, s" OUT.svg"""

import re
import sys


def main():
    report, label, out = sys.argv[1:]
    with open(report, encoding="utf-8") as file:
        pictures = re.findall(r"<svg .*?</svg>", file.read(), flags=re.DOTALL)
    wanted = [picture for picture in pictures if f'aria-label="{label}"' in picture]
    if len(wanted) != 1:
        labels = re.findall(r'aria-label="(.*?)"', " ".join(pictures))
        sys.exit(f"picture.py: {report} has {len(wanted)} curves over {label!r}; expected one of {labels}")
    # What the report's page says for all its pictures.
    style = "<style>text { font: 11px system-ui, sans-serif; fill: #57606a }</style>"
    paper = '<rect width="100%" height="100%" fill="#fff"/>'
    begin, rest = wanted[0].split(">", 1)
    begin = begin.replace("<svg ", '<svg xmlns="http://www.w3.org/2000/svg" ', 1)
    with open(out, "w", encoding="utf-8") as file:
        file.write(f"{begin}>{style}{paper}{rest}\n")


if __name__ == "__main__":
    main()
