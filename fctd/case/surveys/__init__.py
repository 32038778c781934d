"""Surveys: text files, workbooks and WITSML as stations, the checks of stations, and what looks like a mistake.

A reader gives the stations as they are written (`stations.Written`); `stations.check` makes a `stations.Survey` of
them, in metres and radians; `doubts.find` looks for probable mistakes in it.
"""
