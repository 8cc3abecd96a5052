/**
 * Rules of the gateway for POST /join (server/console/join_body.cpp). Its own form at /join has the same ones
 * (server/console/app/sign_in_page.h), and a test compares both.
 */
export const kTicketLength = 1024;
/** A name is for display; it may be empty. */
export const kOptionalNamePattern = '[A-Za-z0-9_\\-]*';
