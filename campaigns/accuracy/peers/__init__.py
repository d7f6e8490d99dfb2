"""Other codes on the works of the accuracy campaign, a module each (`campaigns.accuracy.jobs`)."""
