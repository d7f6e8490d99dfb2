"""Tables: what campaigns write and reports read, so that neither has to know the other.

columns   a column with its unit, symbol and meaning; those that several tables have
files     a table and the dictionary of its columns, written and read
words     words of verdicts and of motions, numbers and lists in print
"""

from tables.columns import *
from tables.files import *
from tables.words import *
