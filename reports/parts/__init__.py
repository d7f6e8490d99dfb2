"""What all reports share: the records a report is made of, how they become HTML and PDF, and how things are said.

columns      tables from the rows of a campaign's table
content      the records that a report is made of
folder       a campaign's folder, read and checked
judged       statements of the paper as a campaign judged them
provenance   how a campaign was made
sections     texts and equations that no run decides
selecting    rows chosen by their entries and put in order, and the picture of the first page
symbols      those of the paper

By their own names are imported: `style`, which loads matplotlib, and `html`, `pdf`, `first_page` and `unchanged`, which
`reports.build` alone needs.
"""

from .columns import *
from .content import *
from .folder import *
from .judged import *
from .provenance import *
from .sections import *
from .selecting import *
from .symbols import *
